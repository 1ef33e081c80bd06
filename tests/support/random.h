// Random inputs for tests: always the same for the same seed, whatever the standard library and compiler. Never draw
// twice among the arguments of one call: their order is the compiler's.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "core/vec.h"
#include "support/salt.h"

namespace lancer {

class Random {
public:
    explicit Random(uint64_t seed) : engine_(salted(seed)) {}

    uint64_t bits() { return engine_(); }
    uint32_t below(uint32_t n) { return static_cast<uint32_t>((engine_() >> 32) * n >> 32); }
    // In [0, 1), of 53 bits.
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double uniform(double a, double b) { return a + (b - a) * uniform(); }
    // In [0, 1), of the 24 bits that samplers give.
    float unit() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }
    Vec2 unit2()
    {
        const float x = unit();
        return {x, unit()};
    }
    double sign() { return engine_() >> 63 ? 1 : -1; }
    // Magnitude 10^[a, b), either sign.
    double log_uniform(double a, double b)
    {
        const double magnitude = std::pow(10.0, uniform(a, b));
        return sign() * magnitude;
    }
    Vec3d point(double a, double b)
    {
        const double x = uniform(a, b), y = uniform(a, b);
        return {x, y, uniform(a, b)};
    }
    Vec3d direction()
    {
        const double z = uniform(-1, 1), phi = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    Vec3 unit_vector() { return normalize(to_float(direction())); }

private:
    std::mt19937_64 engine_;
};

}  // namespace lancer
