// A hash that tells whether inputs changed; not against forgers.
#pragma once

#include <cstdint>
#include <string_view>

namespace lancer {

// FNV-1a with 64 bits; to hash several texts as one, pass the hash so far.
inline uint64_t hash_bytes(std::string_view bytes, uint64_t so_far = 0xcbf29ce484222325u)
{
    for (const char c : bytes) so_far = (so_far ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return so_far;
}

}  // namespace lancer
