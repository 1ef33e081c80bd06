// The sRGB transfer curve (IEC 61966-2-1), exact and piecewise; 1 maps to 1.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace lancer {

// Meaning of the integers of a picture: sRGB colours, or linear data (roughness, bump, normals).
enum class Encoding { srgb, linear };

inline double linear_from_srgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
inline double srgb_from_linear(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// Linear values of the integers 0 to steps - 1; steps is usually 256 or 65536.
inline std::vector<float> make_linear_table(Encoding encoding, size_t steps)
{
    std::vector<float> table(steps);
    for (size_t i = 0; i < steps; ++i) {
        const double v = static_cast<double>(i) / static_cast<double>(steps - 1);
        table[i] = static_cast<float>(encoding == Encoding::srgb ? linear_from_srgb(v) : v);
    }
    return table;
}

}  // namespace lancer
