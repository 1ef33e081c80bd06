// Boxes of spheres and mesh instances for the hand-written accelerators, in float and enlarged by the rounding errors
// of rays and hits.
#pragma once

#include "core/transform.h"
#include "geometry/shapes.h"
#include "geometry/slab.h"
#include "geometry/triangle_set.h"

namespace lancer {

// Box of a sphere, whose hits are computed in double from the float ray: near its silhouette half of double's digits
// are lost.
inline FloatBox box_of(const Sphere& s)
{
    const double r = s.radius * (1 + 0x1p-20);
    const Vec3d reach{r, r, r};
    return rounded_outwards(s.center - reach, s.center + reach);
}

// Box of the finite triangles.
inline FloatBox box_of(const TriangleSet& triangles)
{
    FloatBox box;
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        if (!triangles.is_finite(i)) continue;
        const auto [a, b, c] = triangles.corners(i);
        box.grow(box_of(a, b, c));
    }
    return box;
}

// Box of an instance of a mesh with a non-empty box. In the mesh's space the ray is rounded to float, so that it is off
// by a few ulps of the coordinates.
inline FloatBox box_of(const FloatBox& in_mesh, const Transform& to_world)
{
    constexpr double ulps = gamma(8);
    const Vec3d lower = to_double(in_mesh.lower), upper = to_double(in_mesh.upper);
    if (!is_finite(lower) || !is_finite(upper)) return {-Vec3{1, 1, 1} * FloatBox::inf, Vec3{1, 1, 1} * FloatBox::inf};
    const Vec3d center = to_world.point((lower + upper) * 0.5), a = abs(lower), b = abs(upper);
    const Vec3d half = (upper - lower) * 0.5 + Vec3d{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)} * ulps;
    const Vec3d placed = abs(to_world.x) * half.x + abs(to_world.y) * half.y + abs(to_world.z) * half.z;
    const Vec3d reach = placed + (abs(center) + placed) * ulps;
    return rounded_outwards(center - reach, center + reach);
}

}  // namespace lancer
