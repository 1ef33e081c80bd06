// Where on a triangle a hit is: point, normals, area. Once for a single hit, and once for many, four at a time, with
// the same bits: of what surface_at() does this takes longest.
#pragma once

#include <span>

#include "core/ray.h"
#include "geometry/hit.h"
#include "geometry/shapes.h"

namespace lancer {

struct Scene;

// What intersecting in double leaves, on top of rounding the point to float, for a shape that reaches so far from the
// origin. It alone remains where coordinates vanish: on a floor at y = 0, or where a wall sphere passes the origin.
inline Vec3 rounding_in_double(float reach)
{
    const float e = reach * 0x1p-40f;
    return {e, e, e};
}

// Weight of the first corner, uv being those of the others. In double: the rounding of 1 - u - v is relative to 1, not
// to itself, and a corner may be far away.
inline float first_weight(Vec2 uv)
{
    return static_cast<float>(1.0 - static_cast<double>(uv.x) - static_cast<double>(uv.y));
}

// A point of a mesh's triangle, in the mesh's space. uv: barycentric weights of the second and third corner.
struct PointOnTriangle {
    Vec3 p, p_error;

    PointOnTriangle(const Mesh& mesh, uint32_t triangle, Vec2 uv)
    {
        const auto& t = mesh.triangles[triangle];
        const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        const Vec3 wa = a * first_weight(uv), wb = b * uv.x, wc = c * uv.y;
        p = wa + wb + wc;
        // Section 6.8.5 of Physically Based Rendering, 4th ed.: seven roundings per component.
        const float reach = std::max({max_component(abs(a)), max_component(abs(b)), max_component(abs(c))});
        p_error = (abs(wa) + abs(wb) + abs(wc)) * gamma(7) + rounding_in_double(reach);
    }
};

struct TrianglePlace {
    Vec3 p, p_error, n, ns;  // as in Surface, but n and ns on the front side, ns before any map
    float area = 0;          // of the whole triangle, scene units
};

TrianglePlace triangle_place(const Scene& scene, uint32_t instance, uint32_t mesh, uint32_t triangle, Vec2 uv);

// places[i]: of hits[i], where that is a triangle; others stay as they are.
void triangle_places(const Scene& scene, std::span<const Hit> hits, std::span<TrianglePlace> places);

}  // namespace lancer
