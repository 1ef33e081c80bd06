// Hash functions: of bytes, to detect changed inputs; of integers, for random numbers by address. They are not
// cryptographic.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

namespace lancer {

// seed: the hash of the preceding bytes, if several texts are hashed as one.
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

// Reverses the order of the bits.
constexpr uint32_t reverse_bits(uint32_t x)
{
    x = __builtin_bswap32(x);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

// Finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection in which every bit of z moves every bit.
// T: uint64_t or several of them.
template <class T>
constexpr T mix_bits(T z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

}  // namespace lancer
