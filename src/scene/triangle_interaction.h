// The interaction of a ray with a triangle: point, normals, area. For one hit and for eight at a time with the same
// bits; it is the most expensive part of surface_at().
#pragma once

#include <span>

#include "core/ray.h"
#include "geometry/hit.h"
#include "geometry/shapes.h"
#include "geometry/triangle_lanes.h"

namespace lancer {

struct Scene;

// Error of the intersection in double, in addition to rounding the point to float, for a shape with this largest
// coordinate. It matters where coordinates vanish: on a floor at y = 0, or where a wall sphere crosses the origin.
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

// A point of a triangle by barycentric weights u, v of the second and third corner. T: float or a vector of them.
template <class T>
struct PointOnTriangle {
    T first_weight;  // weight of the first corner
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
    // The error of the intersection in double.
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

// time: Ray::time.
TriangleInteraction triangle_interaction(const Scene& scene, uint32_t instance, uint32_t mesh, uint32_t triangle,
                                         Vec2 uv, float time = 0);

// triangle_interaction() of eight non-instanced triangles.
struct InteractionLanes {
    Vec3x8 p, p_error, n, ns;
    Float8 area;
    TriangleInteraction of(size_t k) const { return {lane(p, k), lane(p_error, k), lane(n, k), lane(ns, k), area[k]}; }
};
InteractionLanes interactions_of(const Scene& scene, std::span<const Hit> hits, const HitIndices& which);
// The same for triangles without corner normals.
InteractionLanes flat_interactions_of(const Scene& scene, std::span<const Hit> hits, const HitIndices& which);
// Stores each interaction at the index of its hit.
inline void put(const InteractionLanes& eight, const HitIndices& which, std::span<TriangleInteraction> places)
{
    for (size_t k = 0; k < float_lanes; ++k) places[which[k]] = eight.of(k);
}

// Prefetching of the shading data of triangles, step by step, so that dependent cache misses overlap. Whether it pays
// off:
bool tables_exceed_caches(const Scene& scene);
// Prefetches materials and normal indices of all hits.
void prefetch_shading(const Scene& scene, std::span<const Hit> hits);
// Prefetches the corner normals of triangle hits; bit i of `which` selects hits[i].
void prefetch_normals(const Scene& scene, std::span<const Hit> hits, uint32_t which);
// Prefetches uv indices, and later the uvs, of hits whose material reads textures.
void prefetch_uv_corners(const Scene& scene, std::span<const Hit> hits, uint32_t which);
void prefetch_uvs(const Scene& scene, std::span<const Hit> hits, uint32_t which);
// Prefetches everything that may be read, in one call.
void prefetch_all(const Scene& scene, std::span<const Hit> hits);

// Computes places[i] for each hits[i], of rays[i], that is a triangle; the others stay unchanged.
void triangle_interactions(const Scene& scene, std::span<const Ray> rays, std::span<const Hit> hits,
                           std::span<TriangleInteraction> places);

}  // namespace lancer
