// What the tests of accelerators share: the list of them, geometry to trace, and when two answers mean the same.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <numbers>
#include <ostream>

#include "geometry/accel.h"
#include "support/random.h"
#include "support/scenes.h"

namespace lancer {

struct AccelMaker {
    std::string_view name;
    AccelKind kind;

    std::unique_ptr<Accelerator> operator()(const Geometry& g) const { return make_accelerator(kind, g, "avx2"); }
    friend void PrintTo(const AccelMaker& m, std::ostream* out) { *out << m.name; }
};
// Every law holds for every accelerator there is.
inline const std::vector<AccelMaker> accel_makers = [] {
    std::vector<AccelMaker> makers;
    for (const AccelName& a : accelerators) makers.push_back({a.name, a.kind});
    return makers;
}();

inline std::string accel_name(const testing::TestParamInfo<AccelMaker>& info) { return std::string(info.param.name); }

inline Mesh to_mesh(const MeshData& data, const Transform& m = {})
{
    Mesh mesh;
    for (const Vec3d& p : data.positions) mesh.positions.push_back(to_float(m.point(p)));
    mesh.positions.emplace_back();
    mesh.triangles = data.triangles;
    return mesh;
}
inline Mesh triangle_mesh(Vec3 a, Vec3 b, Vec3 c)
{
    Mesh mesh;
    mesh.positions = {a, b, c, {}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}
inline Instance make_instance(uint32_t mesh, const Transform& to_world) { return {mesh, to_world, inverse(to_world)}; }

// Meshes, a soup of triangles, instances turned, stretched and mirrored, spheres in and out of each other, planes.
inline Geometry random_geometry(uint64_t seed)
{
    Random random(seed);
    Geometry g;
    g.meshes.push_back(
        to_mesh(*make_uv_sphere(8, 12, 0.2), make_transform({0.5, 0, 0}, {20, 30, 40}, {0.7, 0.7, 0.7})));
    Mesh soup;
    for (uint32_t i = 0; i < 60; ++i) {
        const Vec3d at = random.point(-2, 2);
        for (uint32_t k = 0; k < 3; ++k) soup.positions.push_back(to_float(at + random.point(-0.5, 0.5)));
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    soup.positions.emplace_back();
    g.meshes.push_back(std::move(soup));
    g.meshes.push_back(to_mesh(*make_uv_sphere(6, 8, 0.1)));
    g.meshes.push_back(to_mesh(*make_cube()));
    g.meshes[2].instanced = g.meshes[3].instanced = true;
    for (uint32_t i = 0; i < 5; ++i) {
        Vec3d scale = random.point(0.1, 0.8);
        if (i % 2) scale.y = -scale.y;
        const Vec3d move = random.point(-2, 2), turn_deg = random.point(-180, 180);
        g.instances.push_back(make_instance(2 + i % 2, make_transform(move, turn_deg, scale)));
    }
    for (int i = 0; i < 8; ++i) g.spheres.push_back({random.point(-2, 2), random.uniform(0.05, 0.8)});
    g.planes.push_back({{0, 1, 0}, -2});
    g.planes.push_back({random.direction(), -3});
    return g;
}

// A ray of the kind that path tracing makes, or one aimed at a vertex, an axis-parallel one, one from far away.
inline Ray random_ray(Random& random, const Geometry& g)
{
    Vec3d org = random.point(-2.5, 2.5), dir = random.direction();
    switch (random.below(8)) {
        case 0: {
            const Mesh& m = g.meshes[0];
            const Vec3d at = to_double(m.positions[random.below(static_cast<uint32_t>(m.positions.size() - 1))]);
            dir = normalize(at - org);
            break;
        }
        case 1: {
            const auto axis = random.below(3);
            const double s = random.sign();
            dir = {axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : -0.0};
            break;
        }
        case 2:
            dir = normalize(org - dir * 100.0) * -1.0;
            org = org * 100.0;
            break;
        default:
            break;
    }
    return {.org = to_float(org), .dir = to_float(dir)};
}

inline bool same_primitive(const Hit& a, const Hit& b)
{
    if (!a || !b) return !a && !b;
    return a.kind == b.kind && a.instance == b.instance && a.geometry == b.geometry && a.primitive == b.primitive;
}
inline bool same_bits(const Hit& a, const Hit& b)
{
    return same_primitive(a, b) && std::bit_cast<uint32_t>(a.t) == std::bit_cast<uint32_t>(b.t) &&
           std::bit_cast<uint32_t>(a.uv.x) == std::bit_cast<uint32_t>(b.uv.x) &&
           std::bit_cast<uint32_t>(a.uv.y) == std::bit_cast<uint32_t>(b.uv.y);
}

// Distance of a ray's line to the nearest edge of a triangle, over the size of the coordinates involved, in ulps of
// float: an accelerator that computes in float may decide either way within a few.
inline double ulps_from_edge(const Geometry& g, const Ray& ray, const Hit& hit)
{
    Vec3d org = to_double(ray.org), dir = to_double(ray.dir);
    if (hit.instance != Hit::no_instance) {
        const Transform& m = g.instances[hit.instance].to_mesh;
        org = m.point(org), dir = m.vector(dir);
    }
    const Mesh& mesh = g.meshes[hit.geometry];
    double least = INFINITY, size = length(org);
    for (size_t k = 0; k < 3; ++k) {
        const auto& t = mesh.triangles[hit.primitive];
        const Vec3d a = to_double(mesh.positions[t[k]]), b = to_double(mesh.positions[t[(k + 1) % 3]]);
        const Vec3d across = cross(b - a, dir);
        least = std::min(least, std::abs(dot(across, a - org)) / length(across));
        size = std::max(size, length(a));
    }
    return least / (size * 0x1p-24);
}

// Two answers to one ray that name different primitives are both right where the primitives are equally far, or where
// the ray passes the nearer one's edge by less than float can tell.
inline bool explainable(const Geometry& g, const Ray& ray, const Hit& a, const Hit& b)
{
    if (a && b && std::abs(a.t - b.t) <= 16 * 0x1p-24f * std::max(length(ray.org), std::max(a.t, b.t))) return true;
    const Hit& nearer = !b || (a && a.t < b.t) ? a : b;
    return nearer.kind == Kind::triangle && ulps_from_edge(g, ray, nearer) < 32;
}

}  // namespace lancer
