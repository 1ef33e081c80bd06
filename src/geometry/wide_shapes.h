// Spheres and planes that no tree is good for: walls around a whole scene, and the few shapes of a scene that has no
// others. Each ray is tried with each of them, four rays at once, with the arithmetic of crossing() and intersect() in
// shapes.h and therefore their bits.
#pragma once

#include "geometry/geometry.h"
#include "geometry/lanes.h"

namespace lancer {

// Which shapes: all that few are, or of many spheres those beyond which everything smaller is a speck. Shapes with
// holes are left to the accelerator.
struct WideShapes {
    std::vector<uint32_t> spheres, planes;  // numbers in the Geometry, ascending
};
WideShapes choose_wide_shapes(const Geometry& g);

// Four rays, in double.
struct RayLanes {
    Vec3T<Double4> org, dir;
    Double4 t_min, t_max, dir2;  // dir2: dot(dir, dir)

    // Lanes first to first + 3 of rays laid out as Embree's are: arrays org_x, dir_x, tnear, tfar ...
    template <class Rays>
    RayLanes(const Rays& r, uint32_t first)
        : org{load(r.org_x + first), load(r.org_y + first), load(r.org_z + first)},
          dir{load(r.dir_x + first), load(r.dir_y + first), load(r.dir_z + first)},
          t_min(load(r.tnear + first)),
          t_max(load(r.tfar + first)),
          dir2(dot(dir, dir))
    {
    }
};

// Where each ray meets a shape first, not before t_min; t_max has no part in it.
struct StopLanes {
    Double4 t;  // as it is stored in float
    Mask4 ok;   // it does
    Mask4 exit;
};

inline StopLanes stop(const Sphere& s, const RayLanes& r)
{
    const Double4 radius = all_lanes(s.radius), radius2 = all_lanes(s.radius * s.radius);
    const Vec3T<Double4> center{all_lanes(s.center.x), all_lanes(s.center.y), all_lanes(s.center.z)};
    const Vec3T<Double4> oc = r.org - center;
    const Double4 b = -dot(oc, r.dir);
    const Vec3T<Double4> nearest = oc + r.dir * (b / r.dir2);
    const Double4 discriminant = r.dir2 * (radius2 - dot(nearest, nearest));
    const Double4 distance = sqrt(dot(oc, oc));
    const Double4 c = (distance - radius) * (distance + radius);
    const Double4 q = b + copysign(sqrt(discriminant), b);  // NaN where there is no crossing, and so is the rest
    const Double4 t0 = c / q, t1 = q / r.dir2;
    const Mask4 swapped = t0 > t1;
    const Double4 enter = as_stored(select(swapped, t1, t0)), leave = as_stored(select(swapped, t0, t1));
    const Mask4 exit = ~(enter >= r.t_min);
    const Double4 t = select(exit, leave, enter);
    return {t, (t >= r.t_min) & (q != 0), exit};
}

// The ray is sure not to meet the sphere from 0 to `end`, said without a root or a quotient; false decides nothing. It
// starts outside, and heads away, or would meet it beyond `end`, or passes by. The margins are far above all rounding:
// that of stop(), which near the silhouette is half of double's digits, and that of t to float.
inline Mask4 surely_misses(const Sphere& s, const RayLanes& r, Double4 end)
{
    const Double4 radius2 = all_lanes(s.radius * s.radius);
    const Vec3T<Double4> oc =
        r.org - Vec3T<Double4>{all_lanes(s.center.x), all_lanes(s.center.y), all_lanes(s.center.z)};
    const Double4 oc2 = dot(oc, oc), b = -dot(oc, r.dir), c = oc2 - radius2;
    const Double4 outside = c - (oc2 + radius2) * 0x1p-36, beyond = end * (1 + 0x1p-20), reach = r.dir2 * beyond;
    const Mask4 ends_before = (reach < b) & (beyond * (2 * b - reach) < outside);
    return (outside > 0) & ((b <= 0) | ends_before | (b * b < r.dir2 * outside));
}

inline StopLanes stop(const Plane& p, const RayLanes& r)
{
    const Vec3T<Double4> n{all_lanes(p.normal.x), all_lanes(p.normal.y), all_lanes(p.normal.z)};
    const Double4 exact = (p.offset - dot(n, r.org)) / dot(n, r.dir), t = as_stored(exact);
    return {t, (exact <= plane_extent) & (t >= r.t_min), Mask4{}};
}

}  // namespace lancer
