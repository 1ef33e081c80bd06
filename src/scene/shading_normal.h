// The normal that a surface is shaded with: interpolated, then tilted by a bump or normal map, then kept such that what
// it mirrors stays outside. Mikkelsen, "Surface Gradient-Based Bump Mapping Framework", JCGT 9(3), 2020.
#pragma once

#include <optional>

#include "core/lanes/vec.h"
#include "materials/material.h"

namespace lancer {

// The directions in which u and v grow on a surface, unit; not along each other, nor need they be at right angles.
struct Tangents {
    Vec3 u, v;
    Vec2 unit{1, 1};  // how far one goes in a step of 1 in u, in v, units of the file
};

// ns: unit, on the front side. point: with the uv and the footprint of the place.
Vec3 mapped_normal(const MaterialTraits& traits, const ShadingPoint& point, const Tangents& tangents, Vec3 ns);

// Where a surface of normal ns mirrors wo to, over one of normal n; and whether that is high enough for it: as high as
// a hundredth, or nearly as high as wo if that is lower, since a perfect mirror keeps its normal for every wo. T: float
// or several of them.
template <class T>
struct MirrorImage {
    Vec3T<T> to;
    T least, height;

    MirrorImage(const Vec3T<T>& n, const Vec3T<T>& ns, const Vec3T<T>& wo)
        : to(ns * (2.0f * dot(ns, wo)) - wo), least(smaller(0.9f * dot(n, wo), T{} + 0.01f)), height(dot(n, to))
    {
    }
    auto is_outside() const { return height >= least; }
};

// For surfaces that mirror: the normal nearest to ns, in the plane of ns and wo, about which the mirror image of wo
// lies above the surface. Without this a path that meets a tilted facet ends in black. All unit; dot(n, wo) > 0,
// dot(ns, wo) >= 0.
Vec3 keep_reflection_outside(Vec3 n, Vec3 ns, Vec3 wo);

}  // namespace lancer
