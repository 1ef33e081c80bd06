// The sRGB transfer curve (IEC 61966-2-1), exact and piecewise; 1 maps to 1.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace lancer {

// Meaning of the integers of a picture: sRGB colours, linear data (roughness, bump, normals), or colours as the file
// itself says, which are sRGB where it says nothing.
enum class Encoding { srgb, linear, of_file };

inline double linear_from_srgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
inline double srgb_from_linear(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// Linear values of the integers 0 to steps - 1; steps is usually 256 or 65536. exponent: with Encoding::of_file the
// power that decodes them; 0: none is given.
inline std::vector<float> make_linear_table(Encoding encoding, size_t steps, float exponent = 0)
{
    if (encoding != Encoding::of_file || exponent == 0) exponent = encoding == Encoding::linear ? 1.0f : 0.0f;
    std::vector<float> table(steps);
    for (size_t i = 0; i < steps; ++i) {
        const double v = static_cast<double>(i) / static_cast<double>(steps - 1);
        table[i] = static_cast<float>(exponent == 0   ? linear_from_srgb(v)
                                      : exponent == 1 ? v
                                                      : std::pow(v, static_cast<double>(exponent)));
    }
    return table;
}

}  // namespace lancer
