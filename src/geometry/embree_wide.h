// The shapes that Embree is not told of, tried before it searches: it then has only what is nearer to look for, and
// takes what was found for a hit of its own. Only embree*.{h,cpp} include this.
#pragma once

#include <bit>

#include "geometry/embree_callbacks.h"
#include "geometry/wide_shapes.h"

namespace lancer::embree {

// f(embree geometry, number, stops) for each wide shape, in the order in which the first of equals wins. Spheres may be
// left out that no ray meets up to its `end`, which f may bring nearer.
template <class F>
void for_each_wide(const Geometry& g, const WideShapes& wide, const RayLanes& rays, const Double4& end, F&& f)
{
    for (const uint32_t i : wide.spheres)
        if (bits(surely_misses(g.spheres[i], rays, end)) != all_bits) f(sphere_id(g), i, stop(g.spheres[i], rays));
    for (const uint32_t i : wide.planes) f(plane_id(g), i, stop(g.planes[i], rays));
}

// Shortens the rays to the nearest wide shape and enters it as hit.
inline void closest_wide(const Geometry& g, const WideShapes& wide, RTCRayHit8& r)
{
    for (uint32_t first = 0; first < packet; first += lanes) {
        const RayLanes rays(r.ray, first);
        Double4 best = rays.t_max;
        Mask4 found{}, exit{}, id{};
        for_each_wide(g, wide, rays, best, [&](uint32_t geometry, uint32_t number, const StopLanes& s) {
            const Mask4 nearer = s.ok & ((s.t < best) | (~found & (s.t == best)));
            const auto name = static_cast<int64_t>(uint64_t{geometry} << 32 | number);
            best = select(nearer, s.t, best);
            exit = select(nearer, s.exit, exit);
            id = select(nearer, Mask4{name, name, name, name}, id);
            found |= nearer;
        });
        for (uint32_t left = bits(found); left != 0; left &= left - 1) {
            const auto lane = static_cast<uint32_t>(std::countr_zero(left)), i = first + lane;
            r.ray.tfar[i] = static_cast<float>(best[lane]);
            r.hit.u[i] = exit[lane] ? 1 : 0;
            r.hit.geomID[i] = static_cast<unsigned>(id[lane] >> 32);
            r.hit.primID[i] = static_cast<unsigned>(id[lane]);
        }
    }
}

// Bit i: lane i meets one.
inline uint32_t any_wide(const Geometry& g, const WideShapes& wide, const RTCRay8& r)
{
    uint32_t occluded = 0;
    for (uint32_t first = 0; first < packet; first += lanes) {
        const RayLanes rays(r, first);
        Mask4 found{};
        for_each_wide(g, wide, rays, rays.t_max,
                      [&](uint32_t, uint32_t, const StopLanes& s) { found |= s.ok & (s.t <= rays.t_max); });
        occluded |= bits(found) << first;
    }
    return occluded;
}

}  // namespace lancer::embree
