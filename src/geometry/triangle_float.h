// Watertight ray-triangle intersection in float: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT
// 2(1), 2013, with double where an edge function vanishes. Their distance errs by 1e-4 on slivers; here it is that of
// the plane, and in double for the few triangles that get that far: in float a sliver's plane errs by more than the
// offset of rays that start on it, which would hit their own origin.
#pragma once

#include <algorithm>
#include <optional>

#include "core/ray.h"

namespace lancer {

// The relative error of a triangle's distance that trees of single precision accept; else they compute it in double.
inline constexpr float most_distance_error = 0x1p-17f;

// A ray as axis kz of a sheared space.
struct ShearedRay {
    int kx, ky, kz;
    float sx, sy;
    Vec3 org, dir;

    explicit ShearedRay(const Ray& r) : org(r.org), dir(r.dir)
    {
        kz = largest_axis(r.dir);
        kx = (kz + 1) % 3, ky = (kz + 2) % 3;
        const float sz = 1 / r.dir[kz];
        sx = r.dir[kx] * sz, sy = r.dir[ky] * sz;
    }
};

// By the signs of the edge functions; 0 counts as both signs.
template <class T>
bool is_inside(T u, T v, T w)
{
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

// Parameter of the intersection with the triangle's plane, limited to the range of its corners: a triangle seen almost
// edge-on has no better point. Never NaN. kz: the largest axis of the ray.
inline float distance_to_plane(Vec3 ray_org, Vec3 ray_dir, int kz, Vec3 v0, Vec3 v1, Vec3 v2)
{
    const Vec3d a = to_double(v0), b = to_double(v1), c = to_double(v2);
    const Vec3d org = to_double(ray_org), dir = to_double(ray_dir);
    const Vec3d n = cross(b - a, c - a);
    double t = dot(n, a - org) / dot(n, dir);
    const auto [least, most] = std::minmax({a[kz] - org[kz], b[kz] - org[kz], c[kz] - org[kz]});
    const double z = dir[kz], nearest = (z < 0 ? most : least) / z, farthest = (z < 0 ? least : most) / z;
    if (!(t >= nearest)) t = nearest;
    if (t > farthest) t = farthest;
    return static_cast<float>(t);
}

// Parameter of the intersection with the triangle. Never NaN.
inline std::optional<float> distance_to(const ShearedRay& r, Vec3 v0, Vec3 v1, Vec3 v2)
{
    const Vec3 a = v0 - r.org, b = v1 - r.org, c = v2 - r.org;
    const float ax = a[r.kx] - r.sx * a[r.kz], ay = a[r.ky] - r.sy * a[r.kz];
    const float bx = b[r.kx] - r.sx * b[r.kz], by = b[r.ky] - r.sy * b[r.kz];
    const float cx = c[r.kx] - r.sx * c[r.kz], cy = c[r.ky] - r.sy * c[r.kz];
    const float u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    if (!is_inside(u, v, w)) return {};
    if (u == 0 || v == 0 || w == 0) {
        const auto product = [](float x, float y) { return static_cast<double>(x) * static_cast<double>(y); };
        const double du = product(cx, by) - product(cy, bx), dv = product(ax, cy) - product(ay, cx),
                     dw = product(bx, ay) - product(by, ax);
        if (!is_inside(du, dv, dw) || (du == 0 && dv == 0 && dw == 0)) return {};
    }
    return distance_to_plane(r.org, r.dir, r.kz, v0, v1, v2);
}

}  // namespace lancer
