// Random numbers by address, for tests that draw millions of rays on any number of threads: number n of (seed, index)
// is the same wherever and whenever it is drawn.
#pragma once

#include <cmath>

#include "core/hash.h"
#include "core/vec.h"
#include "support/salt.h"

namespace lancer {

class AddressedRandom {
public:
    AddressedRandom(uint64_t seed, uint64_t index) : key_(mix_bits(mix_bits(salted(seed) + golden) ^ index)) {}

    uint64_t bits() { return mix_bits(key_ += golden); }
    uint32_t below(uint32_t n) { return static_cast<uint32_t>((bits() >> 32) * n >> 32); }
    // In [0, 1), of 53 bits.
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double uniform(double a, double b) { return a + (b - a) * uniform(); }
    Vec3d in_box(Vec3d lower, Vec3d upper)
    {
        const double x = uniform(lower.x, upper.x), y = uniform(lower.y, upper.y);
        return {x, y, uniform(lower.z, upper.z)};
    }
    Vec3d direction()
    {
        const double z = uniform(-1, 1), phi = uniform(0, 2 * pi_d), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    static constexpr uint64_t golden = 0x9e3779b97f4a7c15u;
    uint64_t key_;
};

}  // namespace lancer
