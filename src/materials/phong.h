// What the classic integrators see of a material: Phong's illumination and the parts of light that a surface diffuses,
// reflects and refracts, as in Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980. Every
// material has a member phong(); an interface (interface.h) is nothing else.
#pragma once

#include "core/color.h"

namespace lancer {

struct Phong {
    Color ambient{};      // radiance that stands for light from all around; only the classic integrators add it
    Color diffuse{};      // of diffuse reflection, and the tint of what is refracted; in [0, 1]
    Color specular{};     // of the highlight, and the tint of what is reflected; in [0, 1]
    float shininess = 0;  // exponent of the highlight, >= 0
    float diffusion = 1, reflexion = 0, refraction = 0;  // parts, >= 0; their sum may exceed 1
    float inside_ior = 1, outside_ior = 1;               // behind the geometric normal and in front of it

    friend bool operator==(const Phong&, const Phong&) = default;
};

// From a (t = 0) to b (t = 1), field by field.
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
            .outside_ior = lerp(a.outside_ior, b.outside_ior)};
}

}  // namespace lancer
