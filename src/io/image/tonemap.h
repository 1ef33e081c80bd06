// Tone maps: from linear light to display code values, which io/image/to_bytes.h quantises.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/enum_names.h"
#include "core/srgb.h"

namespace lancer {

enum class ToneMap {
    srgb,     // the sRGB curve, clamped at 1
    agx,      // Troy Sobotka's AgX: bright colours lose saturation before they clip
    none,     // linear
    gamma22,  // the power 1 / 2.2, rounding down; legacy path tracer
    clamped,  // linear, clamped at 1, rounding down; legacy ray tracer
};
template <>
inline constexpr auto enum_names<ToneMap> = std::to_array<std::string_view>({"srgb", "agx", "none", "gamma22",
                                                                             "clamped"});
constexpr bool rounds_down(ToneMap map) { return map == ToneMap::gamma22 || map == ToneMap::clamped; }

// AgX as a matrix into its working space, a logarithm over 16.5 stops, a sigmoid and the way back, in the polynomial
// fit that Benjamin Wrensch published ("Minimal AgX Implementation", 2023). Gives code values for a display of gamma
// 2.2; grey stays grey to a fifteenth of a step of 8 bits. Values below 0 and NaN are taken for 0.
inline std::array<double, 3> agx(std::array<double, 3> linear)
{
    constexpr double in[3][3] = {{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                                 {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                                 {0.0423756549057051, 0.0784336, 0.879142973793104}};
    constexpr double out[3][3] = {{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                                  {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                                  {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}};
    constexpr double darkest = -12.47393, brightest = 4.026069;  // stops from 1
    constexpr double most = 65536;
    for (double& x : linear) x = x > 0 ? std::min(x, most) : 0;
    std::array<double, 3> curved{}, result{};
    for (size_t i = 0; i < 3; ++i) {
        const double y = in[i][0] * linear[0] + in[i][1] * linear[1] + in[i][2] * linear[2];
        const double stops = std::clamp(y > 0 ? std::log2(y) : darkest, darkest, brightest);
        const double x = (stops - darkest) / (brightest - darkest);
        curved[i] = ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
    }
    for (size_t i = 0; i < 3; ++i) result[i] = out[i][0] * curved[0] + out[i][1] * curved[1] + out[i][2] * curved[2];
    return result;
}

// Code values, 0 to 1 in range; NaN becomes 0.
inline std::array<double, 3> to_display(ToneMap map, std::array<double, 3> linear)
{
    if (map == ToneMap::agx) linear = agx(linear);
    for (double& x : linear) {
        x = x > 0 ? std::min(x, 1.0) : 0;
        if (map == ToneMap::srgb && x < 1) x = srgb_from_linear(x);
        if (map == ToneMap::gamma22) x = std::pow(x, 1 / 2.2);
    }
    return linear;
}

}  // namespace lancer
