// Embree's callbacks: spheres and planes as user geometry, and the alpha test as filter. Only files of embree/ include
// it.
#pragma once

#include <limits>

#include "geometry/candidate_hits.h"
#include "geometry/embree/query.h"
#include "geometry/large_shapes.h"
#include "geometry/slab.h"

namespace lancer::embree {

// Geometry ids: meshes have their own index; then follow the spheres, the planes and the instances.
inline uint32_t sphere_id(const Geometry& g) { return static_cast<uint32_t>(g.meshes.size()); }
inline uint32_t plane_id(const Geometry& g) { return sphere_id(g) + 1; }
inline uint32_t first_instance_id(const Geometry& g) { return sphere_id(g) + 2; }

// The user data of every geometry.
struct UserData {
    const Geometry& geometry;
    LargeShapes wide;  // not in Embree's scene
    float extent = 0;  // the largest coordinate of a mesh
};
inline const UserData& user_data(const void* pointer) { return *static_cast<const UserData*>(pointer); }

inline uint32_t instance_of(const Geometry& g, uint32_t embree_instance)
{
    return embree_instance == RTC_INVALID_GEOMETRY_ID ? Hit::no_instance : embree_instance - first_instance_id(g);
}

template <Kind kind>
const auto& shapes(const Geometry& g)
{
    if constexpr (kind == Kind::sphere)
        return g.spheres;
    else
        return g.planes;
}

template <Kind kind>
const std::vector<uint32_t>& numbers_of(const LargeShapes& wide)
{
    return kind == Kind::sphere ? wide.spheres : wide.planes;
}

// Embree ignores primitives with an empty box.
inline RTCBounds outwards(const Bounds& b)
{
    const FloatBox f = rounded_outwards(b.lower, b.upper);
    return {f.lower.x, f.lower.y, f.lower.z, 0, f.upper.x, f.upper.y, f.upper.z, 0};
}

// The ray with its present t_max. Spheres and planes are not in instances, so it is the original ray otherwise.
inline Ray lane_ray(const BaseContext* context, RTCRayN* r, unsigned n, unsigned i)
{
    return {{RTCRayN_org_x(r, n, i), RTCRayN_org_y(r, n, i), RTCRayN_org_z(r, n, i)},
            RTCRayN_tnear(r, n, i),
            {RTCRayN_dir_x(r, n, i), RTCRayN_dir_y(r, n, i), RTCRayN_dir_z(r, n, i)},
            RTCRayN_tfar(r, n, i),
            original_ray(context, RTCRayN_id(r, n, i)).key};
}

template <Kind kind>
void bounds_callback(const RTCBoundsFunctionArguments* a)
{
    const UserData& data = user_data(a->geometryUserPtr);
    const std::vector<uint32_t>& wide = numbers_of<kind>(data.wide);
    const bool left_out = std::binary_search(wide.begin(), wide.end(), a->primID);
    *a->bounds_o = outwards(left_out ? Bounds{} : bounds(shapes<kind>(data.geometry)[a->primID]));
}

inline Context& context_of(BaseContext* context) { return *static_cast<Context*>(context); }

// Embree rounds the distance to a triangle, in its ways of traversal differently; which way a ray goes depends on the
// rays beside it. The rounding is a few steps of float of the distance (stability row G6) or, of near hits, of the
// coordinates: the slack of the ray. Hits that are closer together are all looked at and ordered by exact distances, so
// that the nearest hit of a ray is the same in any packet. A small part of the distance bounds it: one far vertex must
// not make everything close.
inline float distance_error(float t, float slack) { return std::min(t * 0x1p-20f + slack, t * 0x1p-8f); }
inline float beyond(float t, float slack) { return t + distance_error(t, slack); }

// Whether `hit` of ray id is nearer than its nearest one so far, which it then replaces.
inline bool take(const Geometry& g, Context& context, uint32_t id, Hit hit)
{
    const Ray& ray = context.rays[id];
    Hit& nearest = context.nearest[id];
    if (nearest && hit.t >= nearest.t - distance_error(nearest.t, context.slack[id])) {
        if (hit.t > beyond(nearest.t, context.slack[id])) return false;
        nearest = refine(g, ray, nearest), hit = refine(g, ray, hit);
        if (!is_nearer(hit, nearest)) return false;
    }
    nearest = hit;
    return true;
}

template <Kind kind>
void intersect_callback(const RTCIntersectFunctionNArguments* a)
{
    const Geometry& g = user_data(a->geometryUserPtr).geometry;
    RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const uint32_t id = RTCRayN_id(rays, a->N, i);
        Context& context = context_of(a->context);
        const Hit hit = first_opaque_hit<kind>(g, a->primID, lane_ray(a->context, rays, a->N, i));
        const bool is_taken = hit && take(g, context, id, hit);
#if RTC_VERSION_MAJOR >= 4
        a->valid[i] = is_taken ? -1 : 0;
#endif
        if (is_taken)
            RTCRayN_tfar(rays, a->N, i) = std::min(RTCRayN_tfar(rays, a->N, i), beyond(hit.t, context.slack[id]));
    }
}

template <Kind kind>
void occluded_callback(const RTCOccludedFunctionNArguments* a)
{
    const Geometry& g = user_data(a->geometryUserPtr).geometry;
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const bool hit{first_opaque_hit<kind>(g, a->primID, lane_ray(a->context, a->ray, a->N, i))};
#if RTC_VERSION_MAJOR >= 4
        a->valid[i] = hit ? -1 : 0;
#endif
        if (hit) RTCRayN_tfar(a->ray, a->N, i) = -std::numeric_limits<float>::infinity();
    }
}

inline Hit candidate_triangle(const Geometry& g, const RTCFilterFunctionNArguments* a, unsigned i)
{
    return {RTCRayN_tfar(a->ray, a->N, i),
            instance_of(g, RTCHitN_instID(a->hit, a->N, i, 0)),
            RTCHitN_geomID(a->hit, a->N, i),
            RTCHitN_primID(a->hit, a->N, i),
            {},
            Kind::triangle};
}

// Both are called for each candidate hit of a mesh, in any order, and repeatedly for triangles that are split. A filter
// may change tfar (Embree's documentation of RTCFilterFunctionN); Embree restores it where the hit is refused.
inline void nearest_callback(const RTCFilterFunctionNArguments* a)
{
    const Geometry& g = user_data(a->geometryUserPtr).geometry;
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const uint32_t id = RTCRayN_id(a->ray, a->N, i);
        Context& context = context_of(a->context);
        const Hit hit = candidate_triangle(g, a, i);
        const bool is_taken = !passes_through(g, context.rays[id], hit) && take(g, context, id, hit);
        if (is_taken)
            RTCRayN_tfar(a->ray, a->N, i) = beyond(hit.t, context.slack[id]);
        else
            a->valid[i] = 0;
    }
}
// Only for meshes with an alpha test.
inline void occlusion_callback(const RTCFilterFunctionNArguments* a)
{
    const Geometry& g = user_data(a->geometryUserPtr).geometry;
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const Ray& ray = original_ray(a->context, RTCRayN_id(a->ray, a->N, i));
        if (passes_through(g, ray, candidate_triangle(g, a, i))) a->valid[i] = 0;
    }
}

}  // namespace lancer::embree
