// Sweeps beside rows N, G and R of the stability matrix.
#include <cmath>

#include "stability/exact.h"
#include "stability/fast_embree.h"
#include "stability/pictures.h"
#include "stability/sweep.h"
#include "support/watertight.h"

namespace lancer::stability {
namespace {

// The test that one would write first: Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
std::optional<float> naive_t(const Mesh& mesh, uint32_t triangle, const Ray& ray)
{
    const auto& i = mesh.triangles[triangle];
    const Vec3 a = mesh.positions[i[0]], e1 = mesh.positions[i[1]] - a, e2 = mesh.positions[i[2]] - a;
    const Vec3 p = cross(ray.dir, e2);
    const float det = dot(e1, p);
    if (det == 0) return {};
    const Vec3 s = ray.org - a, q = cross(s, e1);
    const float u = dot(s, p) / det, v = dot(ray.dir, q) / det, t = dot(e2, q) / det;
    if (u < 0 || v < 0 || u + v > 1 || t < 0) return {};
    return t;
}

// Where rays that leave a surface start, above it, as a part of the scene.
Sweep offsets()
{
    SweepCurve product{"lancer", {}}, fixed{"a constant of 1e-4", {}};
    for (int power = -20; power <= 18; power += 2) {
        const double size = std::pow(10.0, power);
        SceneDescription d;
        d.meshes.push_back(make_mesh(make_uv_sphere(12, 24, 0.1), {{}, {10, 20, 30}, {size / 2, size / 2, size / 2}}));
        d.lights.push_back(sky_of({1, 1, 1}));
        const Scene scene = build_scene(d);
        const auto accel = make_accelerator(AccelKind::bvh8, scene.geometry, "avx2");
        double most = 0;
        for (uint64_t i = 0; i < 500; ++i) {
            AddressedRandom random(1, i);
            const Vec3d dir = random.direction();
            const Vec3 org = to_float(dir * -2.0);
            const Ray ray{.org = org, .dir = to_float(dir)};
            const Hit hit = accel->closest(ray);
            if (!hit) continue;
            const Surface s = surface_at(scene, ray, hit);
            most = std::max(most, std::abs(dot(to_double(s.origin) - to_double(s.p), to_double(s.n))));
        }
        product.points.push_back({size, most / (size * scene.normalisation.scale)});
        fixed.points.push_back({size, 1e-4 / size});
    }
    return {"Where rays start that leave a surface",
            "size of the scene",
            "height above the surface, of the scene's size",
            {product, fixed}};
}

Mesh ball_at(double distance) { return moved(to_mesh(*make_uv_sphere(20, 40)), Vec3d{1, -0.5, 0.25} * distance); }

// Rays from inside a closed ball, at edges, that leave it through nothing, where the scene is not moved to the origin.
Sweep leaks_far_away()
{
    SweepCurve robust{"Embree as lancer uses it", {}}, own{"bvh8", {}}, fast{"Embree, fast mode", {}},
        naive{"Moeller and Trumbore, float, every triangle", {}};
    for (int power = 0; power <= 6; ++power)
        for (const double factor : {1.0, 3.0}) {
            const double distance = factor * std::pow(10.0, power);
            Geometry g;
            g.meshes.push_back(ball_at(distance));
            const std::vector<Ball> balls = balls_inside(g, 1);
            if (balls.empty()) continue;  // coarser than float there
            const RaysFromInside rays(g.meshes[0], balls);
            constexpr uint64_t count = 5000;
            const auto add = [&](SweepCurve& curve, const Accelerator& accel) {
                const auto lost = count_misses(accel, rays, Aim::edge, Asked::singly, 0, count);
                curve.points.push_back({distance, static_cast<double>(lost) / count});
            };
            add(robust, *make_accelerator(AccelKind::embree, g, "avx2"));
            add(own, *make_accelerator(AccelKind::bvh8, g, "avx2"));
            add(fast, *make_fast_embree(g));
            uint64_t lost = 0;
            for (uint64_t i = 0; i < count; ++i) {
                bool hit = false;
                for (uint32_t t = 0; t < g.meshes[0].triangles.size() && !hit; ++t)
                    hit = naive_t(g.meshes[0], t, rays.ray(Aim::edge, i)).has_value();
                lost += !hit;
            }
            naive.points.push_back({distance, static_cast<double>(lost) / count});
        }
    return {"Leaks of a closed mesh far from the origin",
            "distance over size",
            "part of rays at edges that leave it",
            {robust, own, fast, naive}};
}

// Distances to a mesh that a file places far away, against what the file says.
Sweep distances_far_away()
{
    SweepCurve product{"lancer, which moves the scene", {}}, naive{"Moeller and Trumbore, float, where it is", {}};
    for (int power = 0; power <= 8; ++power) {
        const double distance = std::pow(10.0, power);
        const Vec3d there = Vec3d{1, -0.5, 0.25} * distance;
        SceneDescription d;
        const auto ball = make_uv_sphere(20, 40);
        d.meshes.push_back(make_mesh(ball, {there, {}, {1, 1, 1}}));
        d.lights.push_back(sky_of({1, 1, 1}));
        const Scene scene = build_scene(d);
        const auto accel = make_accelerator(AccelKind::bvh8, scene.geometry, "avx2");
        const Mesh in_place = ball_at(distance);
        double error = 0, naive_error = 0, n = 0;
        for (uint64_t i = 0; i < 2000; ++i) {
            AddressedRandom random(1, i);
            const Vec3d dir = random.direction(), org = there - dir * 2.0 + random.direction() * 0.3;
            const Ray ray{.org = to_float(scene.normalisation.to_scene(org)), .dir = to_float(dir)};
            const Hit hit = accel->closest(ray);
            if (!hit) continue;
            const auto& corners = ball->triangles[hit.primitive];
            const auto exact = intersect_plane_of(ball->positions[corners[0]], ball->positions[corners[1]],
                                                  ball->positions[corners[2]], org - there, dir);
            if (!exact) continue;
            error += std::abs(static_cast<double>(hit.t) / scene.normalisation.scale - exact->t);
            const auto t = naive_t(in_place, hit.primitive, {.org = to_float(org), .dir = to_float(dir)});
            naive_error +=
                t ? std::abs(static_cast<double>(*t) - exact->t) : 1;  // lost: as far off as the ball is wide
            ++n;
        }
        product.points.push_back({distance, error / n});
        naive.points.push_back({distance, naive_error / n});
    }
    return {"Distance to a mesh far from the origin",
            "distance over size",
            "mean error of t, of the mesh's size",
            {product, naive}};
}

}  // namespace

std::vector<Sweep> scale_sweeps() { return {offsets(), leaks_far_away(), distances_far_away()}; }

}  // namespace lancer::stability
