// A hash of bytes that tells whether inputs changed. Not cryptographic.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

namespace lancer {

// To hash several texts as one, pass the hash so far.
inline uint64_t hash_bytes(std::string_view bytes, uint64_t so_far = 0)
{
    constexpr uint64_t prime = 0x9E3779B185EBCA87u;
    uint64_t hash = (so_far ^ bytes.size()) * prime;
    while (!bytes.empty()) {
        uint64_t word = 0;
        const size_t n = bytes.size() < sizeof word ? bytes.size() : sizeof word;
        std::memcpy(&word, bytes.data(), n);
        hash = (hash ^ word) * prime;
        hash ^= hash >> 32;
        bytes.remove_prefix(n);
    }
    return hash;
}

}  // namespace lancer
