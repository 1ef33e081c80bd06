#include "stability/sphere_cases.h"

#include "core/frame.h"
#include "core/parallel.h"
#include "materials/material.h"
#include "stability/exact.h"
#include "stability/pictures.h"
#include "support/addressed.h"

namespace lancer::stability {
namespace {

Ray leave(const Surface& s, Vec3 w) { return {.org = ray_origin(s, w), .dir = w}; }

// A room of side 2 between six spheres of that radius.
SceneDescription wall_room(double r)
{
    SceneDescription d;
    for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
        for (const double side : {-1.0, 1.0}) d.spheres.push_back(sphere_of(axis * (side * (r + 1)), r));
    d.spheres.push_back(sphere_of({0.3, -0.8, 0.2}, 0.2));
    d.lights.push_back(sky_of({1, 1, 1}));
    return d;
}

struct Walk {
    double stuck = 0, leaks = 0;
};
Walk walk(const Scene& scene, const Accelerator& accel, size_t bounces, uint64_t seed)
{
    const float side = static_cast<float>(scene.normalisation.scale);
    AddressedRandom random(seed, 0);
    const auto start = [&]() -> Ray { return {.org = {}, .dir = to_float(random.direction())}; };
    Ray ray = start();
    uint32_t last = UINT32_MAX;
    Walk found;
    for (size_t i = 0; i < bounces; ++i) {
        const Hit hit = accel.closest(ray);
        // Not a second time, from outside, where one has just been.
        if (hit && hit.primitive == last) ++found.stuck;
        const Surface s = hit ? surface_at(scene, ray, hit) : Surface{};
        if (!hit || max_component(abs(s.p)) > 1.001f * side) {
            ++found.leaks;
            ray = start();
            last = UINT32_MAX;
            continue;
        }
        last = hit.primitive;
        Vec3 w = to_float(random.direction());
        if (dot(w, s.n) < 0) w = -w;
        ray = leave(s, w);
    }
    return found;
}

// Of the surfaces that a ray meets in a shell: of the outer and the inner ball, in and out again.
constexpr std::array<uint32_t, 4> order{0, 1, 1, 0};

struct Passage {
    uint32_t surfaces = 0;
    bool in_order = true;
    double throughput = 1;
};
// refract: as the material says; else straight on.
Passage pass(const Scene& scene, const Accelerator& accel, Ray ray, bool refract)
{
    Passage p;
    for (; p.surfaces < 8; ++p.surfaces) {
        const Hit hit = accel.closest(ray);
        if (!hit) return p;
        p.in_order = p.in_order && p.surfaces < order.size() && hit.primitive == order[p.surfaces];
        const Surface s = surface_at(scene, ray, hit);
        Vec3 w = ray.dir;
        if (refract) {
            const Frame frame(s.ns);
            const auto* glass = std::get_if<Glass>(&scene.materials[s.material]);
            const GlassBsdf bsdf = glass->at(scene.shading_point(s));
            const auto sample = bsdf.sample(frame.to_local(-ray.dir), 1 - 0x1p-24f, {});
            if (!sample || sample->wi.z > 0) return p;
            p.throughput *= static_cast<double>(sample->pdf) * static_cast<double>(sample->weight.r);
            w = frame.to_world(sample->wi);
        }
        ray = leave(s, w);
    }
    return p;
}

Real transmitted(Real cos_i, Real cos_t, Real eta)
{
    const Real rs = (cos_i - eta * cos_t) / (cos_i + eta * cos_t), rp = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return 1 - (rs * rs + rp * rp) / 2;
}
// What comes through four boundaries of concentric spheres: the line's distance from the centre, times the index, is
// the same in all media.
Real exact_passage(Real b, Real inner_radius, Real ior)
{
    const auto cosine = [](Real sine) { return std::sqrt((1 - sine) * (1 + sine)); };
    const Real outer = transmitted(cosine(b), cosine(b / ior), ior);
    const Real inside = transmitted(cosine(b / ior / inner_radius), cosine(b / inner_radius), 1 / ior);
    return outer * outer * inside * inside;
}

}  // namespace

ShellCount cross_shell(const std::string& accelerator, double thickness, size_t rays)
{
    SceneDescription d;
    MaterialDescription glass = make_lambert("glass", {1, 1, 1});
    glass.type = MaterialType::glass;
    glass.ior = 1.5f;
    d.materials = {glass};
    const double inner_radius = 1 - thickness;
    for (const auto part : {SphereDescription::Part::bubble, SphereDescription::Part::inside_of_bubble}) {
        d.spheres.push_back(sphere_of({}, part == SphereDescription::Part::bubble ? 1 : inner_radius, "glass"));
        d.spheres.back().part = part;
    }
    d.lights.push_back(sky_of({1, 1, 1}));
    const Scene scene = build_scene(d);
    const auto accel = make_accelerator(value_of<AccelKind>(accelerator).value(), scene.geometry, "avx2");
    ShellCount count;
    count.rays = static_cast<double>(rays);
    for (size_t i = 0; i < rays; ++i) {
        AddressedRandom random(3, i);
        const Vec3d axis = random.direction(), side = normalize(cross(axis, random.direction()));
        const double off = inner_radius * (1 - 1e-6) * std::sqrt(random.uniform());
        const Vec3d at = side * off;
        const Vec3 org = to_float((at - axis * 3.0) * scene.normalisation.scale);
        const Ray ray{.org = org, .dir = to_float(axis)};
        // As float has it.
        const Real r0 = scene.geometry.spheres[0].radius;
        const Roots exact = roots(scene.geometry.spheres[0], ray);
        const Real b = std::sqrt(1 - exact.discriminant);
        const Passage straight = pass(scene, *accel, ray, false), bent = pass(scene, *accel, ray, true);
        count.wrong_straight += straight.surfaces != 4 || !straight.in_order;
        count.wrong_refracted += bent.surfaces != 4 || !bent.in_order;
        const Real truth = exact_passage(b, scene.geometry.spheres[1].radius / r0, 1.5L);
        const double error = static_cast<double>(std::abs(bent.throughput / truth - 1));
        count.worst_radiance = std::max(count.worst_radiance, error);
        if (off < 0.9) count.worst_radiance_inside = std::max(count.worst_radiance_inside, error);
    }
    return count;
}

Outcome wall_walk(const Setup& setup)
{
    Outcome out;
    const size_t bounces = setup.scaled(60000, 10000000, 10000000);
    for (const double r : {1e5, 1e6}) {
        const Scene scene = build_scene(wall_room(r));
        for (const char* name : judged_names) {
            const auto accel = make_accelerator(value_of<AccelKind>(name).value(), scene.geometry, "avx2");
            const Walk found = walk(scene, *accel, bounces, 1);
            const std::string where = ", radius 1e" + std::to_string(std::ilogb(r) > 18 ? 6 : 5) + ", " + name;
            out.measures.push_back(at_most("hits of the wall that was left" + where, found.stuck, 0));
            out.measures.push_back(at_most("leaks" + where, found.leaks, 0));
        }
    }
    return out;
}

Outcome nested_shells(const Setup& setup)
{
    Outcome out;
    for (const char* name : judged_names)
        for (const int power : {4, 5, 6}) {
            const ShellCount c = cross_shell(name, std::pow(10.0, -power), setup.scaled(20000, 1000000, 1000000));
            const std::string where = ", thickness 1e-" + std::to_string(power) + ", " + name;
            const bool judged = power <= 5;
            const auto add = [&](const std::string& what, double value, double threshold, bool is_judged) {
                out.measures.push_back(is_judged ? at_most(what + where, value, threshold) : told(what + where, value));
            };
            add("straight rays that meet other than four surfaces", c.wrong_straight, 0, judged);
            add("refracted rays that do", c.wrong_refracted, 0, judged);
            add("error of what comes through up to 0.9 radii from the middle, relative", c.worst_radiance_inside, 1e-5,
                power == 4);
            add("error of what comes through up to the rim, relative", c.worst_radiance, 1e-5, false);
        }
    return out;
}

Outcome tangent_rays(const Setup& setup)
{
    Outcome out;
    // One alone, which is tried by itself, and many in a tree, some in others.
    for (const size_t count : {1, 60}) {
        Geometry g;
        for (size_t i = 0; i < count; ++i) {
            AddressedRandom random(5, i);
            const Vec3d at = random.in_box({-100, -100, -100}, {100, 100, 100});
            g.spheres.push_back({at, std::pow(10.0, random.uniform(-3, 2))});
        }
        for (const char* name : judged_names) {
            const auto accel = make_accelerator(value_of<AccelKind>(name).value(), g, "avx2");
            double wrong = 0;
            const size_t rays = setup.scaled(count == 1 ? 40000 : 10000, 1000000, 1000000);
            for (size_t i = 0; i < rays; ++i) {
                AddressedRandom random(6, i);
                const Sphere& s = g.spheres[random.below(static_cast<uint32_t>(count))];
                const Vec3d axis = random.direction(), side = normalize(cross(axis, random.direction()));
                const double off = 1 + (random.below(2) ? 1 : -1) * std::pow(10.0, random.uniform(-7, -1));
                const double back = std::pow(10.0, random.uniform(0, 3)) * s.radius;
                const Ray ray{.org = to_float(s.center - axis * back + side * (off * s.radius)), .dir = to_float(axis)};
                double nearest = INFINITY;
                bool tangent = false;
                for (const Sphere& other : g.spheres) {
                    const Roots exact = roots(other, ray);
                    tangent = tangent || std::abs(exact.discriminant) <= 1e-6L;
                    if (exact.discriminant < 0 || exact.t1 <= 0) continue;
                    nearest = std::min(nearest, static_cast<double>(exact.t0 > 0 ? exact.t0 : exact.t1));
                }
                if (tangent) continue;
                const Hit hit = accel->closest(ray);
                const bool hits = nearest < INFINITY;
                wrong += static_cast<bool>(hit) != hits || accel->any(ray) != hits ||
                         (hits && ulps_between(static_cast<double>(hit.t), nearest) > 2);
            }
            out.measures.push_back(
                at_most("wrong of rays past " + std::to_string(count) + " spheres, " + name, wrong, 0));
        }
    }
    return out;
}

}  // namespace lancer::stability
