// Spheres and planes that are tested for every ray instead of being in a BVH: walls around the scene, and all shapes of
// a scene that has few. Four rays are tested at once with the arithmetic of crossing() and intersect() in shapes.h, and
// therefore with their bits.
#pragma once

#include <array>
#include <limits>

#include "core/lanes/lanes.h"
#include "geometry/geometry.h"

namespace lancer {

// The selected shapes: all spheres and planes if there are few, else the spheres that are much larger than all others.
// Shapes with an alpha test stay in the accelerator.
struct LargeShapes {
    std::vector<uint32_t> spheres, planes;  // numbers in the Geometry, ascending

    bool empty() const { return spheres.empty() && planes.empty(); }
};
LargeShapes choose_large_shapes(const Geometry& g);

// Four rays, in double.
struct RayLanes {
    Vec3T<Double4> org, dir;
    Double4 t_min, t_max, dir2;  // dir2: dot(dir, dir)

    // Rays first to first + 3 of a packet in Embree's layout: arrays org_x, dir_x, tnear, tfar ...
    template <class Rays>
    RayLanes(const Rays& r, uint32_t first)
        : org{load(r.org_x + first), load(r.org_y + first), load(r.org_z + first)},
          dir{load(r.dir_x + first), load(r.dir_y + first), load(r.dir_z + first)},
          t_min(load(r.tnear + first)),
          t_max(load(r.tfar + first)),
          dir2(dot(dir, dir))
    {
    }

private:
    static Double4 load(const float* from) { return to_double(load4(from)); }
};

// The first hit of each ray after t_min; t_max is ignored.
struct StopLanes {
    Double4 t;  // rounded to float
    Mask4 ok;   // there is a hit
    Mask4 exit;
};

// One sphere per lane.
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
    const Double4 q = b + copysign(sqrt(discriminant), b);  // NaN where there is no intersection
    const Double4 t0 = c / q, t1 = q / r.dir2;
    const Mask4 swapped = t0 > t1;
    const Double4 enter = as_stored(select(swapped, t1, t0)), leave = as_stored(select(swapped, t0, t1));
    const Mask4 exit = ~(enter >= r.t_min);
    const Double4 t = select(exit, leave, enter);
    return {t, (t >= r.t_min) & (q != 0), exit};
}

// Whether a ray certainly misses a sphere between 0 and `end`, without a square root or a division; false is undecided.
// True if the origin is outside and the ray points away, passes by, or would hit beyond `end`. The margins exceed all
// rounding errors, including that of stop() near the silhouette.
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

// For eight rays the sphere that each one probably hits first. Testing it first rules out most others. It affects speed
// only. rays: in Embree's layout.
template <class Rays>
std::array<uint32_t, float_lanes> probably_first(const std::vector<Sphere>& spheres, const std::vector<uint32_t>& order,
                                                 const Rays& r)
{
    const Vec3T<Float8> org{load8_anywhere(r.org_x), load8_anywhere(r.org_y), load8_anywhere(r.org_z)};
    const Vec3T<Float8> dir{load8_anywhere(r.dir_x), load8_anywhere(r.dir_y), load8_anywhere(r.dir_z)};
    Float8 first = broadcast(std::numeric_limits<float>::infinity());
    Mask8 place{};
    for (uint32_t k = 0; k < order.size(); ++k) {
        const Sphere& s = spheres[order[k]];
        const Vec3 center = to_float(s.center);
        const auto radius = static_cast<float>(s.radius);
        const Vec3T<Float8> oc = org - Vec3T<Float8>{broadcast(center.x), broadcast(center.y), broadcast(center.z)};
        const Float8 oc2 = dot(oc, oc), b = -dot(oc, dir), c = oc2 - radius * radius;
        // An origin on the surface counts as outside: most rays leave a surface.
        const Float8 t = b - copysign(sqrt(b * b - c), c + oc2 * 0x1p-16f);
        const Mask8 nearer = (t > 0.0f) & (t < first);
        first = select(nearer, t, first);
        place = (nearer & static_cast<int32_t>(k)) | (~nearer & place);
    }
    std::array<uint32_t, float_lanes> places;
    store8_anywhere(places.data(), reinterpret_cast<UInt8>(place));
    return places;
}

inline StopLanes stop(const Plane& p, const RayLanes& r)
{
    const Vec3T<Double4> n{broadcast(p.normal.x), broadcast(p.normal.y), broadcast(p.normal.z)};
    const Double4 exact = (p.offset - dot(n, r.org)) / dot(n, r.dir), t = as_stored(exact);
    return {t, (exact <= plane_extent) & (t >= r.t_min), Mask4{}};
}

}  // namespace lancer
