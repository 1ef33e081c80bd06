// Phong parameters of a material for the classic integrators: ambient, diffuse and specular colour and the parts of
// diffuse, reflected and refracted light, as in Whitted, "An Improved Illumination Model for Shaded Display", CACM
// 23(6), 1980. Every material has a member phong().
#pragma once

#include <algorithm>

#include "core/color.h"

namespace lancer {

struct Phong {
    Color ambient{};                                     // ambient radiance; only the classic integrators add it
    Color diffuse{};                                     // diffuse reflectance and tint of refraction; in [0, 1]
    Color specular{};                                    // highlight and tint of reflection; in [0, 1]
    float shininess = 0;                                 // exponent of the highlight, >= 0
    float diffusion = 1, reflexion = 0, refraction = 0;  // weights, >= 0; their sum may exceed 1
    float inside_ior = 1, outside_ior = 1;               // behind the geometric normal and in front of it
    float sheet_ior = 0;  // of a thin sheet, whose two indices are 1: it reflects as glass of this one; 0: none

    friend bool operator==(const Phong&, const Phong&) = default;
};

// Linear interpolation from a (t = 0) to b (t = 1).
inline Phong mix(float t, const Phong& a, const Phong& b)
{
    const auto lerp = [t](const auto& x, const auto& y) { return x * (1 - t) + y * t; };
    return {.ambient = lerp(a.ambient, b.ambient),
            .diffuse = lerp(a.diffuse, b.diffuse),
            .specular = lerp(a.specular, b.specular),
            .shininess = lerp(a.shininess, b.shininess),
            .diffusion = lerp(a.diffusion, b.diffusion),
            .reflexion = lerp(a.reflexion, b.reflexion),
            .refraction = lerp(a.refraction, b.refraction),
            .inside_ior = lerp(a.inside_ior, b.inside_ior),
            .outside_ior = lerp(a.outside_ior, b.outside_ior),
            .sheet_ior = std::max(a.sheet_ior, b.sheet_ior)};
}

}  // namespace lancer
