// Random numbers for tests, independent of the sampler under test.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "core/vec.h"

namespace lancer {

class Random {
public:
    explicit Random(uint64_t seed) : engine_(seed) {}

    float get1() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }  // in [0, 1)
    Vec2 get2()
    {
        const float x = get1();
        return {x, get1()};
    }
    double uniform(double low, double high)
    {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    Vec3d in_box(double half)
    {
        const double x = uniform(-half, half), y = uniform(-half, half);
        return {x, y, uniform(-half, half)};
    }
    Vec3d direction()
    {
        const double z = uniform(-1, 1), phi = uniform(0, 2 * 3.14159265358979323846), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace lancer
