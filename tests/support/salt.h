// Other random numbers for all tests: with LANCER_TEST_SALT=N in the environment each of them draws what it never drew
// before. A test that then fails, though nothing is wrong, stood on luck.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/hash.h"

namespace lancer {

inline bool is_salted() { return std::getenv("LANCER_TEST_SALT") != nullptr; }

// Without the variable the seed itself.
inline uint64_t salted(uint64_t seed)
{
    static const uint64_t salt = is_salted() ? mix_bits(std::stoull(std::getenv("LANCER_TEST_SALT")) + 1) : 0;
    return salt ? mix_bits(seed ^ salt) : seed;
}

}  // namespace lancer
