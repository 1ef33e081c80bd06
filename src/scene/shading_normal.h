// The normal that a surface is shaded with: interpolated, then tilted by a bump or normal map, then kept such that what
// it mirrors stays outside. Mikkelsen, "Surface Gradient-Based Bump Mapping Framework", JCGT 9(3), 2020.
#pragma once

#include <optional>

#include "core/vec.h"
#include "materials/material.h"

namespace lancer {

// The directions in which u and v grow on a surface, unit; not along each other, nor need they be at right angles.
struct Tangents {
    Vec3 u, v;
    Vec2 unit{1, 1};  // how far one goes in a step of 1 in u, in v, units of the file
};

// ns: unit, on the front side. point: with the uv and the footprint of the place.
Vec3 mapped_normal(const MaterialTraits& traits, const ShadingPoint& point, const Tangents& tangents, Vec3 ns);

// For surfaces that mirror: the normal nearest to ns, in the plane of ns and wo, about which the mirror image of wo
// lies above the surface. Without this a path that meets a tilted facet ends in black. All unit; dot(n, wo) > 0,
// dot(ns, wo) >= 0.
Vec3 keep_reflection_outside(Vec3 n, Vec3 ns, Vec3 wo);

}  // namespace lancer
