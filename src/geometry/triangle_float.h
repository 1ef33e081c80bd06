// A ray against a triangle in float, so that no ray passes between neighbours: Woop, Benthin, Wald, "Watertight
// Ray/Triangle Intersection", JCGT 2(1), 2013, with double where an edge function vanishes. The distance is not theirs,
// which errs by 1e-4 on slivers, but that of the plane through differences of the corners.
#pragma once

#include <optional>

#include "core/ray.h"

namespace lancer {

// A ray as the axis kz of a sheared space.
struct ShearedRay {
    int kx, ky, kz;
    float sx, sy, sz;
    Vec3 org;

    explicit ShearedRay(const Ray& r) : org(r.org)
    {
        const Vec3 m = abs(r.dir);
        kz = m.x > m.y ? (m.x > m.z ? 0 : 2) : (m.y > m.z ? 1 : 2);
        kx = (kz + 1) % 3, ky = (kz + 2) % 3;
        sz = 1 / r.dir[kz];
        sx = r.dir[kx] * sz, sy = r.dir[ky] * sz;
    }
};

// Of the edges' signs: 0 counts for both sides.
template <class T>
bool is_inside(T u, T v, T w)
{
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

// Where the ray's line meets the triangle. Not NaN.
inline std::optional<float> distance_to(const ShearedRay& r, Vec3 v0, Vec3 v1, Vec3 v2)
{
    const Vec3 a = v0 - r.org, b = v1 - r.org, c = v2 - r.org;
    const float ax = a[r.kx] - r.sx * a[r.kz], ay = a[r.ky] - r.sy * a[r.kz];
    const float bx = b[r.kx] - r.sx * b[r.kz], by = b[r.ky] - r.sy * b[r.kz];
    const float cx = c[r.kx] - r.sx * c[r.kz], cy = c[r.ky] - r.sy * c[r.kz];
    const float u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    if (!is_inside(u, v, w)) return {};
    if (u == 0 || v == 0 || w == 0) {
        const auto d = [](float x) { return static_cast<double>(x); };
        if (!is_inside(d(cx) * d(by) - d(cy) * d(bx), d(ax) * d(cy) - d(ay) * d(cx), d(bx) * d(ay) - d(by) * d(ax)))
            return {};
    }
    const Vec3 n = cross(v1 - v0, v2 - v0);
    const float t = (n[r.kx] * a[r.kx] + n[r.ky] * a[r.ky] + n[r.kz] * a[r.kz]) * r.sz /
                    (n[r.kx] * r.sx + n[r.ky] * r.sy + n[r.kz]);
    if (t != t) return {};
    return t;
}

}  // namespace lancer
