// Unit vectors in 32 bits: two numbers of 16 bits on an octahedron that is unfolded to a square. Meyer, Süßmuth,
// Sußner, Stamminger, Greiner, "On Floating-Point Normal Vectors", Computer Graphics Forum 29(4), 2010. Of the four
// codes around a vector the nearest is taken, as by "oct32P" of Cigolle et al., "A Survey of Efficient Representations
// for Independent Unit Vectors", JCGT 3(2), 2014: the angle is off by less than 0.003 degrees.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/vec.h"

namespace lancer {

// Both numbers are from -most to most; this code is none of a vector.
inline constexpr uint32_t no_octahedral = 0x80008000;

namespace octahedral {

inline constexpr int most = 32767;
inline uint32_t code_of(int x, int y) { return (static_cast<uint32_t>(x) & 0xFFFF) | (static_cast<uint32_t>(y) << 16); }

}  // namespace octahedral

inline Vec3 from_octahedral(uint32_t code)
{
    constexpr float unit = 1.0f / octahedral::most;
    const auto x = static_cast<float>(static_cast<int16_t>(code & 0xFFFF)) * unit;
    const auto y = static_cast<float>(static_cast<int16_t>(code >> 16)) * unit;
    const float z = 1 - std::abs(x) - std::abs(y), fold = std::max(-z, 0.0f);
    const Vec3 v{x - std::copysign(fold, x), y - std::copysign(fold, y), z};
    return v * (1 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z));
}

// v: unit.
inline uint32_t to_octahedral(const Vec3& v)
{
    const Vec3d d = to_double(v) / (std::abs(to_double(v).x) + std::abs(to_double(v).y) + std::abs(to_double(v).z));
    const bool below = d.z < 0;
    const double x = below ? std::copysign(1 - std::abs(d.y), d.x) : d.x;
    const double y = below ? std::copysign(1 - std::abs(d.x), d.y) : d.y;
    const auto least = [](double part) {
        return std::clamp(static_cast<int>(std::floor(part * octahedral::most)), -octahedral::most,
                          octahedral::most - 1);
    };
    const int left = least(x), low = least(y);
    uint32_t nearest = no_octahedral;
    double least_distance = 5;  // squared; of unit vectors 4 at most
    for (int i = 0; i < 4; ++i) {
        const uint32_t code = octahedral::code_of(left + (i & 1), low + (i >> 1));
        const Vec3d off = to_double(from_octahedral(code)) - to_double(v);
        if (dot(off, off) >= least_distance) continue;
        nearest = code, least_distance = dot(off, off);
    }
    return nearest;
}

}  // namespace lancer
