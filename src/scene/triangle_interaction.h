// Where on a triangle a hit is: point, normals, area. Once for a single hit, and once for many, eight at a time, with
// the same bits: of what surface_at() does this takes longest.
#pragma once

#include <span>

#include "core/ray.h"
#include "geometry/hit.h"
#include "geometry/shapes.h"
#include "geometry/triangle_lanes.h"

namespace lancer {

struct Scene;

// What intersecting in double leaves, on top of rounding the point to float, for a shape that reaches so far from the
// origin. It alone remains where coordinates vanish: on a floor at y = 0, or where a wall sphere passes the origin.
template <class T>
T rounding_in_double(T reach)
{
    return reach * 0x1p-40f;
}

// Weight of the first corner, uv being those of the others. In double: the rounding of 1 - u - v is relative to 1, not
// to itself, and a corner may be far away.
inline float first_weight(float u, float v)
{
    return static_cast<float>(1.0 - static_cast<double>(u) - static_cast<double>(v));
}
inline float first_weight(Vec2 uv) { return first_weight(uv.x, uv.y); }
inline Float8 first_weight(Float8 u, Float8 v)
{
    const auto half = [](Float4 second, Float4 third) { return to_float(1.0 - to_double(second) - to_double(third)); };
    return concat(half(lower(u), lower(v)), half(upper(u), upper(v)));
}

// A point of a triangle. T: float or several of them; u, v: barycentric weights of the second and third corner.
template <class T>
struct PointOnTriangle {
    T first_weight;  // of the first corner
    Vec3T<T> p, p_error;

    PointOnTriangle(const Vec3T<T>& a, const Vec3T<T>& b, const Vec3T<T>& c, T u, T v)
        : PointOnTriangle(a, b, c, u, v, rounding(a, b, c))
    {
    }
    // rounded: rounding() of the corners.
    PointOnTriangle(const Vec3T<T>& a, const Vec3T<T>& b, const Vec3T<T>& c, T u, T v, T rounded)
        : first_weight(lancer::first_weight(u, v))
    {
        const Vec3T<T> wa = a * first_weight, wb = b * u, wc = c * v;
        p = wa + wb + wc;
        // Section 6.8.5 of Physically Based Rendering, 4th ed.: seven roundings per component.
        p_error = (abs(wa) + abs(wb) + abs(wc)) * (T{} + gamma(7)) + Vec3T<T>{rounded, rounded, rounded};
    }
    // What is left of intersecting in double.
    static T rounding(const Vec3T<T>& a, const Vec3T<T>& b, const Vec3T<T>& c)
    {
        return rounding_in_double(larger(largest(abs(a)), larger(largest(abs(b)), largest(abs(c)))));
    }

private:
    static T largest(const Vec3T<T>& v) { return larger(v.x, larger(v.y, v.z)); }
};
inline PointOnTriangle<float> point_on_triangle(const Mesh& mesh, uint32_t triangle, Vec2 uv)
{
    const auto& t = mesh.triangles[triangle];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], uv.x, uv.y};
}

struct TriangleInteraction {
    Vec3 p, p_error, n, ns;  // as in Surface, but n and ns on the front side, ns before any map
    float area = 0;          // of the whole triangle, scene units
};

TriangleInteraction triangle_interaction(const Scene& scene, uint32_t instance, uint32_t mesh, uint32_t triangle,
                                         Vec2 uv);

// triangle_interaction() of eight triangles that are drawn as they are.
struct InteractionLanes {
    Vec3x8 p, p_error, n, ns;
    Float8 area;
    TriangleInteraction of(size_t k) const { return {lane(p, k), lane(p_error, k), lane(n, k), lane(ns, k), area[k]}; }
};
InteractionLanes interactions_of(const Scene& scene, std::span<const Hit> hits, const HitIndices& which);
// The same of triangles whose corners have no normals of their own.
InteractionLanes flat_interactions_of(const Scene& scene, std::span<const Hit> hits, const HitIndices& which);
// Each to the place of its hit.
inline void put(const InteractionLanes& eight, const HitIndices& which, std::span<TriangleInteraction> places)
{
    for (size_t k = 0; k < float_lanes; ++k) places[which[k]] = eight.of(k);
}

// What is kept of each triangle besides its corners is asked for early, step by step, so that who reads it need not
// wait for one line of memory after the other. Whether that pays:
bool tables_exceed_caches(const Scene& scene);
// Of all that were hit: material, and which normals the corners have.
void prefetch_shading(const Scene& scene, std::span<const Hit> hits);
// Then, where they are triangles, these normals. which: bit i: of hits[i].
void prefetch_normals(const Scene& scene, std::span<const Hit> hits, uint32_t which);
// Where materials read textures: which points of them the corners have, and later these.
void prefetch_uv_corners(const Scene& scene, std::span<const Hit> hits, uint32_t which);
void prefetch_uvs(const Scene& scene, std::span<const Hit> hits, uint32_t which);
// For who does not go by steps: whatever may be read.
void prefetch_all(const Scene& scene, std::span<const Hit> hits);

// places[i]: of hits[i], where that is a triangle; others stay as they are.
void triangle_interactions(const Scene& scene, std::span<const Hit> hits, std::span<TriangleInteraction> places);

}  // namespace lancer
