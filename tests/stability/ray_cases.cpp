#include "stability/ray_cases.h"

#include <mutex>

#include "core/parallel.h"
#include "scene/alpha_test.h"
#include "stability/exact.h"
#include "stability/pictures.h"
#include "support/agreement.h"
#include "support/closed_mesh.h"
#include "support/ray_kinds.h"

namespace lancer::stability {
namespace {

struct Found {
    Agreement closest, any;
    uint64_t missed = 0;  // though the reference met something, whatever excuses there are

    void operator+=(const Found& f) { closest += f.closest, any += f.any, missed += f.missed; }
};
Found compare(const Geometry& g, const Setup& setup, uint64_t rays_of_kind)
{
    const DoubleTree reference(g);
    const auto accel = setup.make(g);
    const RaysOfKinds rays(g);
    constexpr uint64_t chunk = 1000;
    const uint64_t chunks = (rays_of_kind + chunk - 1) / chunk;
    Found all;
    std::mutex mutex;
    parallel_for(chunks * ray_kinds.size(), [&](size_t part) {
        const RayKind kind = ray_kinds[part % ray_kinds.size()];
        const uint64_t first = part / ray_kinds.size() * chunk;
        Found f;
        for (uint64_t i = first; i < std::min(rays_of_kind, first + chunk); ++i) {
            const Ray ray = rays.ray(kind, i);
            const Hit expected = reference.closest(ray), hit = accel->closest(ray);
            f.closest.count(g, ray, i, expected, hit);
            f.any.count_any(g, ray, i, expected, accel->any(ray), hit);
            f.missed += expected && !hit ? 1 : 0;
        }
        const std::scoped_lock lock(mutex);
        all += f;
    });
    return all;
}

}  // namespace

Outcome many_rays(const Setup& setup)
{
    Found all;
    const uint64_t count = setup.scaled(1000, 100000, 1000000);
    // Embree's fast mode sees meshes alone, without holes.
    const auto plain = [](const Geometry& g) {
        return g.spheres.empty() && g.planes.empty() && !g.alpha_test.passes_through;
    };
    for (const auto& [name, d] : all_test_scenes()) {
        Scene scene = build_scene(d);
        bind_alpha_test(scene);
        const bool triangles = scene.triangle_count() > 0;
        if (triangles && (!setup.fast() || plain(scene.geometry))) all += compare(scene.geometry, setup, count);
    }
    const Mesh bumpy = to_mesh(*make_uv_sphere(40, 80, 0.15));
    for (const double size : {1e-6, 1.0, 1e6})
        for (const double far : {0.0, 1e5, 1e7}) {
            Geometry g;
            g.meshes.push_back(moved(bumpy, {}));
            for (Vec3& p : g.meshes[0].positions) p = p * static_cast<float>(size);
            g.meshes[0] = moved(g.meshes[0], Vec3d{1, -0.5, 0.25} * (far * size));
            // At 1e7 sizes away float holds one corner of it.
            if (far < 1e7 || size < 1) all += compare(g, setup, count / 2);
        }
    Outcome out;
    out.measures = {at_most("wrong hits", static_cast<double>(all.closest.wrong), 0),
                    at_most("wrong answers to whether anything is hit", static_cast<double>(all.any.wrong), 0),
                    told("nothing found, per million rays, all within float's rounding of an edge",
                         1e6 * static_cast<double>(all.missed) / static_cast<double>(all.closest.rays)),
                    told("rays", static_cast<double>(all.closest.rays))};
    return out;
}

Outcome nearest_of_many(const Setup& setup)
{
    Geometry g;
    for (size_t i = 0; i < 10000; ++i) {
        AddressedRandom random(1, i);
        const Vec3d at = random.in_box({-1, -1, -1}, {1, 1, 1});
        g.spheres.push_back({at, std::pow(10.0, random.uniform(-2.5, -0.5))});
    }
    const size_t count = setup.scaled(800, 200000, 1000000);
    struct Case {
        Ray ray;
        double t;
        uint32_t sphere;
    };
    std::vector<Case> cases(count);
    parallel_for(count, [&](size_t i) {
        AddressedRandom random(2, i);
        // Half from afar, half from within.
        const Vec3d org = random.direction() * (random.below(2) ? 4.0 : 1.0);
        const Vec3d at = random.in_box({-1, -1, -1}, {1, 1, 1});
        Case& c = cases[i];
        c = {{.org = to_float(org), .dir = to_float(normalize(at - org))}, INFINITY, 0};
        for (uint32_t k = 0; k < g.spheres.size(); ++k) {
            const Roots exact = roots(g.spheres[k], c.ray);
            if (exact.discriminant < 0 || exact.t1 <= 0) continue;
            const auto t = static_cast<double>(exact.t0 > 0 ? exact.t0 : exact.t1);
            if (t < c.t) c.t = t, c.sphere = k;
        }
    });
    Outcome out;
    for (const char* name : judged_names) {
        const auto accel = make_accelerator(value_of<AccelKind>(name).value(), g, "avx2");
        double wrong = 0;
        for (const Case& c : cases) {
            const Hit hit = accel->closest(c.ray);
            const bool same = c.t < INFINITY ? hit && ulps_between(static_cast<double>(hit.t), c.t) <= 2 : !hit;
            wrong += !same;
        }
        out.measures.push_back(at_most(std::string("wrong nearest, ") + name, wrong, 0));
    }
    out.measures.push_back(told("rays", static_cast<double>(count)));
    return out;
}

}  // namespace lancer::stability
