// The shapes: data, bounds and intersection of each, written once for Embree's callbacks, the hand-written accelerators
// and the list. All in double: for a wall sphere of radius 1e5 every float formula errs by up to 0.4, double by 6e-5.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/bounds.h"
#include "core/ray.h"
#include "core/transform.h"
#include "core/vec.h"

namespace lancer {

struct Mesh {
    // Vertices, each followed by a second row if rows is 2: its normal, in the same cache line. One entry more than
    // used: Embree reads 16 bytes at a time.
    std::vector<Vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;  // vertex indices; counter-clockwise seen from the front
    uint32_t rows = 1;                               // entries per vertex
    bool instanced = false;                          // only drawn as instances

    size_t vertices() const { return positions.empty() ? 0 : (positions.size() - 1) / rows; }
    const Vec3& vertex(size_t i) const { return positions[i * rows]; }
};

// An instance of a mesh, with the maps between the mesh's own space and the scene's.
struct Instance {
    uint32_t mesh = 0;
    Transform to_world, to_mesh;
};

struct Sphere {
    Vec3d center;
    double radius = 1;

    friend bool operator==(const Sphere&, const Sphere&) = default;
};

// Points p with dot(normal, p) = offset; normal is unit.
struct Plane {
    Vec3d normal{0, 1, 0};
    double offset = 0;
};

// Extent of planes in scene units: far beyond the resolution of float at the horizon, below the limit of Embree.
inline constexpr double plane_extent = 1e15;

inline Bounds bounds(const Sphere& s)
{
    const Vec3d r{s.radius, s.radius, s.radius};
    return {s.center - r, s.center + r};
}

// A slab of zero thickness if the plane is perpendicular to an axis, so that it affects a BVH little.
inline Bounds bounds(const Plane& p)
{
    const auto lower = [&](double n) { return std::abs(n) < 1 ? -plane_extent : p.offset * n; };
    const auto upper = [&](double n) { return std::abs(n) < 1 ? plane_extent : p.offset * n; };
    return {{lower(p.normal.x), lower(p.normal.y), lower(p.normal.z)},
            {upper(p.normal.x), upper(p.normal.y), upper(p.normal.z)}};
}

// Whether t lies in the ray's interval after rounding to float, so that a result does not depend on the order of tests.
inline bool reaches(const Ray& ray, double t)
{
    const auto stored = static_cast<float>(t);
    return stored >= ray.t_min && stored <= ray.t_max;
}

// The parameters at which a line enters and leaves a sphere; enter <= exit.
struct Crossing {
    double enter, exit;
};

// The discriminant from the distance of the centre to the ray does not cancel for far or tiny spheres: Haines,
// Guenther, Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, chapter 7.
inline std::optional<Crossing> crossing(const Sphere& s, const Ray& ray)
{
    const Vec3d o = to_double(ray.org), d = to_double(ray.dir);
    const Vec3d oc = o - s.center;
    const double a = dot(d, d), b = -dot(oc, d);
    const Vec3d nearest = oc + d * (b / a);
    const double discriminant = a * (s.radius * s.radius - dot(nearest, nearest));
    if (!(discriminant >= 0)) return {};
    const double distance = length(oc);
    const double c = (distance - s.radius) * (distance + s.radius);
    const double q = b + std::copysign(std::sqrt(discriminant), b);
    if (q == 0) return {};
    double t0 = c / q, t1 = q / a;
    if (t0 > t1) std::swap(t0, t1);
    return Crossing{t0, t1};
}

// The nearest t in [t_min, t_max].
inline std::optional<double> intersect(const Sphere& s, const Ray& ray)
{
    const auto c = crossing(s, ray);
    if (c && reaches(ray, c->enter)) return c->enter;
    if (c && reaches(ray, c->exit)) return c->exit;
    return {};
}

inline std::optional<double> intersect(const Plane& p, const Ray& ray)
{
    const double t = (p.offset - dot(p.normal, to_double(ray.org))) / dot(p.normal, to_double(ray.dir));
    // NaN (a ray within the plane) fails both tests.
    if (t <= plane_extent && reaches(ray, t)) return t;
    return {};
}

struct TriangleHit {
    double t, u, v;  // u, v: weights of the second and third corner
    bool inside;     // else t, u, v belong to the triangle's plane
};

// Edge functions of a triangle in the space where the ray is the z axis; neighbours compute the same number for their
// common edge, so no ray passes between them. Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1),
// 2013, in double throughout. T: double or several of them.
template <class T>
struct PlaneHit {
    T w0, w1, w2, det;
    T t, u, v;  // u, v: weights of the second and third corner; meaningless where det is 0

    // In coordinates whose third axis is the ray's largest.
    PlaneHit(const Vec3T<T>& v0, const Vec3T<T>& v1, const Vec3T<T>& v2, const Vec3T<T>& org, const Vec3T<T>& dir)
    {
        const T sz = 1.0 / dir.z, sx = dir.x * sz, sy = dir.y * sz;
        const Vec3T<T> a = v0 - org, b = v1 - org, c = v2 - org;
        const T ax = a.x - sx * a.z, ay = a.y - sy * a.z;
        const T bx = b.x - sx * b.z, by = b.y - sy * b.z;
        const T cx = c.x - sx * c.z, cy = c.y - sy * c.z;
        w0 = cx * by - cy * bx, w1 = ax * cy - ay * cx, w2 = bx * ay - by * ax;
        det = w0 + w1 + w2;
        const T r = 1.0 / det;
        t = (w0 * a.z + w1 * b.z + w2 * c.z) * sz * r;
        u = w1 * r;
        v = w2 * r;
    }
};

// Returns nothing for a triangle seen exactly edge-on.
inline std::optional<TriangleHit> intersect_plane_of(Vec3d v0, Vec3d v1, Vec3d v2, Vec3d org, Vec3d dir)
{
    const int kz = largest_axis(dir), kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    const auto turned = [&](const Vec3d& v) { return Vec3d{v[kx], v[ky], v[kz]}; };
    const PlaneHit<double> h(turned(v0), turned(v1), turned(v2), turned(org), turned(dir));
    if (h.det == 0) return {};
    const bool inside = (h.w0 >= 0 && h.w1 >= 0 && h.w2 >= 0) || (h.w0 <= 0 && h.w1 <= 0 && h.w2 <= 0);
    return TriangleHit{h.t, h.u, h.v, inside};
}

inline std::optional<TriangleHit> intersect_plane_of(const Mesh& mesh, uint32_t primitive, Vec3d org, Vec3d dir)
{
    const auto& i = mesh.triangles[primitive];
    return intersect_plane_of(to_double(mesh.positions[i[0]]), to_double(mesh.positions[i[1]]),
                              to_double(mesh.positions[i[2]]), org, dir);
}

}  // namespace lancer
