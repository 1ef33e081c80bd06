// Large shapes outside Embree's scene. They are tested before Embree's traversal, which then only searches nearer hits.
// Only files of embree/ include it.
#pragma once

#include <bit>

#include "geometry/embree/callbacks.h"
#include "geometry/large_shapes.h"

namespace lancer::embree {

// The nearest large shapes of four rays.
struct NearestLargeShape {
    Double4 t;
    Mask4 found{}, exit{}, id{};  // id: Embree geometry << 32 | index

    // Of equal distances the lowest id wins.
    void take(Mask4 candidate, const StopLanes& s)
    {
        const Mask4 nearer = s.ok & ((s.t < t) | ((s.t == t) & (~found | (candidate < id))));
        t = select(nearer, s.t, t);
        exit = select(nearer, s.exit, exit);
        id = select(nearer, candidate, id);
        found |= nearer;
    }
};
inline Mask4 large_shape_id(uint32_t geometry, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const auto id = [&](uint32_t number) { return static_cast<int64_t>(uint64_t{geometry} << 32 | number); };
    return Mask4{id(a), id(b), id(c), id(d)};
}

// Sets the nearest hits of the query's rays to large shapes, and r's tfar.
inline void closest_large_shape(const Geometry& g, const LargeShapes& wide, Query& query, RTCRayHit8& r)
{
    const bool any_sphere = !wide.spheres.empty();
    const auto first_of =
        any_sphere ? probably_first(g.spheres, wide.spheres, r.ray) : std::array<uint32_t, float_lanes>{};
    for (uint32_t first = 0; first < packet; first += double_lanes) {
        const RayLanes rays(r.ray, first);
        NearestLargeShape best{.t = rays.t_max};
        Mask4 tried{};
        if (any_sphere) {
            const auto number = [&](uint32_t lane) { return wide.spheres[first_of[first + lane]]; };
            const auto sphere = [&](uint32_t lane) -> const Sphere& { return g.spheres[number(lane)]; };
            tried = large_shape_id(sphere_id(g), number(0), number(1), number(2), number(3));
            best.take(tried, stop(SphereLanes(sphere(0), sphere(1), sphere(2), sphere(3)), rays));
        }
        for (const uint32_t i : wide.spheres) {
            const Mask4 id = large_shape_id(sphere_id(g), i, i, i, i);
            if (movemask((id == tried) | surely_misses(g.spheres[i], rays, best.t)) != all_bits)
                best.take(id, stop(SphereLanes(g.spheres[i]), rays));
        }
        for (const uint32_t i : wide.planes)
            best.take(large_shape_id(plane_id(g), i, i, i, i), stop(g.planes[i], rays));
        for (uint32_t left = movemask(best.found); left != 0; left &= left - 1) {
            const auto lane = static_cast<uint32_t>(std::countr_zero(left)), i = first + lane;
            const bool is_sphere = best.id[lane] >> 32 == sphere_id(g);
            Hit& nearest = query.nearest(i);
            nearest.t = static_cast<float>(best.t[lane]), nearest.primitive = static_cast<uint32_t>(best.id[lane]);
            nearest.kind = is_sphere ? Kind::sphere : Kind::plane, nearest.exit = best.exit[lane] != 0;
            r.ray.tfar[i] = beyond(nearest.t, query.slack(i));
        }
    }
}

// Bit i: lane i hits a large shape.
inline uint32_t any_large_shape(const Geometry& g, const LargeShapes& wide, const RTCRay8& r)
{
    uint32_t occluded = 0;
    for (uint32_t first = 0; first < packet; first += double_lanes) {
        const RayLanes rays(r, first);
        Mask4 found{};
        const auto take = [&](const StopLanes& s) { found |= s.ok & (s.t <= rays.t_max); };
        for (const uint32_t i : wide.spheres)
            if (movemask(found | surely_misses(g.spheres[i], rays, rays.t_max)) != all_bits)
                take(stop(SphereLanes(g.spheres[i]), rays));
        for (const uint32_t i : wide.planes) take(stop(g.planes[i], rays));
        occluded |= movemask(found) << first;
    }
    return occluded;
}

}  // namespace lancer::embree
