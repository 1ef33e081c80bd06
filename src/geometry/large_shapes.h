// Spheres and planes that no tree is good for: walls around a whole scene, and the few shapes of a scene that has no
// others. Each ray is tried with each of them, four rays at once, with the arithmetic of crossing() and intersect() in
// shapes.h and therefore their bits.
#pragma once

#include <array>
#include <limits>

#include "core/lanes/lanes.h"
#include "geometry/geometry.h"

namespace lancer {

// Which shapes: all that few are, or of many spheres those beyond which everything smaller is a speck. Shapes with
// holes are left to the accelerator.
struct LargeShapes {
    std::vector<uint32_t> spheres, planes;  // numbers in the Geometry, ascending

    bool empty() const { return spheres.empty() && planes.empty(); }
};
LargeShapes choose_large_shapes(const Geometry& g);

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

// Of each lane a sphere.
struct SphereLanes {
    Vec3T<Double4> center;
    Double4 radius;

    explicit SphereLanes(const Sphere& s)
        : center{broadcast(s.center.x), broadcast(s.center.y), broadcast(s.center.z)}, radius(broadcast(s.radius))
    {
    }
    SphereLanes(const Sphere& a, const Sphere& b, const Sphere& c, const Sphere& d)
        : center{Double4{a.center.x, b.center.x, c.center.x, d.center.x},
                 Double4{a.center.y, b.center.y, c.center.y, d.center.y},
                 Double4{a.center.z, b.center.z, c.center.z, d.center.z}},
          radius{a.radius, b.radius, c.radius, d.radius}
    {
    }
};

inline StopLanes stop(const SphereLanes& s, const RayLanes& r)
{
    const Double4 radius = s.radius, radius2 = radius * radius;
    const Vec3T<Double4> oc = r.org - s.center;
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
    const Double4 radius2 = broadcast(s.radius * s.radius);
    const Vec3T<Double4> oc =
        r.org - Vec3T<Double4>{broadcast(s.center.x), broadcast(s.center.y), broadcast(s.center.z)};
    const Double4 oc2 = dot(oc, oc), b = -dot(oc, r.dir), c = oc2 - radius2;
    const Double4 outside = c - (oc2 + radius2) * 0x1p-36, beyond = end * (1 + 0x1p-20), reach = r.dir2 * beyond;
    const Mask4 ends_before = (reach < b) & (beyond * (2 * b - reach) < outside);
    return (outside > 0) & ((b <= 0) | ends_before | (b * b < r.dir2 * outside));
}

// For eight rays the sphere that each probably meets first: the place in `order` of one that is tried first then lets
// most others be left out. Nothing depends on it but time. rays: as Embree's.
template <class Rays>
std::array<uint32_t, float_lanes> probably_first(const std::vector<Sphere>& spheres, const std::vector<uint32_t>& order,
                                                 const Rays& r)
{
    const auto load8 = [](const float* from) { return Float8{_mm256_loadu_ps(from)}; };
    const Vec3T<Float8> org{load8(r.org_x), load8(r.org_y), load8(r.org_z)};
    const Vec3T<Float8> dir{load8(r.dir_x), load8(r.dir_y), load8(r.dir_z)};
    Float8 first = broadcast(std::numeric_limits<float>::infinity());
    Mask8 place{};
    for (uint32_t k = 0; k < order.size(); ++k) {
        const Sphere& s = spheres[order[k]];
        const Vec3 center = to_float(s.center);
        const auto radius = static_cast<float>(s.radius);
        const Vec3T<Float8> oc = org - Vec3T<Float8>{broadcast(center.x), broadcast(center.y), broadcast(center.z)};
        const Float8 oc2 = dot(oc, oc), b = -dot(oc, dir), c = oc2 - radius * radius;
        // On the surface, as far as float tells, is outside: most rays leave one.
        const Float8 t = b - copysign(sqrt(b * b - c), c + oc2 * 0x1p-16f);
        const Mask8 nearer = (t > 0.0f) & (t < first);
        first = select(nearer, t, first);
        place = (nearer & static_cast<int32_t>(k)) | (~nearer & place);
    }
    std::array<uint32_t, float_lanes> places;
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(places.data()), reinterpret_cast<__m256i>(place));
    return places;
}

inline StopLanes stop(const Plane& p, const RayLanes& r)
{
    const Vec3T<Double4> n{broadcast(p.normal.x), broadcast(p.normal.y), broadcast(p.normal.z)};
    const Double4 exact = (p.offset - dot(n, r.org)) / dot(n, r.dir), t = as_stored(exact);
    return {t, (exact <= plane_extent) & (t >= r.t_min), Mask4{}};
}

}  // namespace lancer
