// Embree's callbacks: spheres and planes as user geometry, and the alpha test as filter. Only files of embree/ include
// it.
#pragma once

#include <limits>

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

template <Kind kind>
void intersect_callback(const RTCIntersectFunctionNArguments* a)
{
    const Geometry& g = user_data(a->geometryUserPtr).geometry;
    RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
    RTCHitN* hits = RTCRayHitN_HitN(a->rayhit, a->N);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const Hit hit = first_opaque_hit<kind>(g, a->primID, lane_ray(a->context, rays, a->N, i));
#if RTC_VERSION_MAJOR >= 4
        a->valid[i] = hit ? -1 : 0;
#endif
        if (!hit) continue;
        // Ties go to the lowest (instance, geometry, primitive), whatever Embree's order.
        const unsigned geometry = RTCHitN_geomID(hits, a->N, i);
        if (geometry != RTC_INVALID_GEOMETRY_ID && hit.t == RTCRayN_tfar(rays, a->N, i) &&
            (RTCHitN_instID(hits, a->N, i, 0) != RTC_INVALID_GEOMETRY_ID || geometry < a->geomID ||
             (geometry == a->geomID && RTCHitN_primID(hits, a->N, i) < a->primID))) {
#if RTC_VERSION_MAJOR >= 4
            a->valid[i] = 0;
#endif
            continue;
        }
        RTCRayN_tfar(rays, a->N, i) = hit.t;
        RTCHitN_u(hits, a->N, i) = hit.exit ? 1 : 0;
        RTCHitN_geomID(hits, a->N, i) = a->geomID;
        RTCHitN_primID(hits, a->N, i) = a->primID;
        RTCHitN_instID(hits, a->N, i, 0) = a->context->instID[0];
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

// Called for each candidate hit of a mesh with an alpha test, in any order, and repeatedly for triangles that are
// split.
inline void filter_callback(const RTCFilterFunctionNArguments* a)
{
    const Geometry& g = user_data(a->geometryUserPtr).geometry;
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const uint32_t mesh = RTCHitN_geomID(a->hit, a->N, i), triangle = RTCHitN_primID(a->hit, a->N, i);
        if (!g.alpha_test.meshes[mesh][triangle]) continue;
        const Ray& ray = original_ray(a->context, RTCRayN_id(a->ray, a->N, i));
        const uint32_t instance = instance_of(g, RTCHitN_instID(a->hit, a->N, i, 0));
        const Hit hit{RTCRayN_tfar(a->ray, a->N, i), instance, mesh, triangle, {}, Kind::triangle};
        if (g.alpha_test.passes_through(g.alpha_test.context, ray, refine(g, ray, hit))) a->valid[i] = 0;
    }
}

}  // namespace lancer::embree
