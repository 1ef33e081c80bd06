// The geometry of a scene as plain arrays: the input of accelerators. It contains no shading data.
#pragma once

#include <vector>

#include "geometry/hit.h"
#include "geometry/motion.h"
#include "geometry/shapes.h"

namespace lancer {

struct Geometry;

// The stochastic alpha test of surfaces with an opacity below 1. Accelerators call it at every hit of a marked
// primitive. It is a function pointer, so that geometry does not depend on shading.
struct AlphaTest {
    // Whether the ray passes through the surface at the hit, whose t and uv are refined. The result depends on
    // (ray.key, primitive, side of a sphere) only, not on the order of calls or on ray.t_max, which shrinks during
    // traversal. Null: all surfaces are opaque.
    bool (*passes_through)(const void* context, const Ray& ray, const Hit& hit) = nullptr;
    const void* context = nullptr;
    // Parallel to Geometry::meshes: for each triangle whether to call the test; empty for a mesh that is opaque.
    std::vector<std::vector<uint8_t>> meshes;
    bool spheres = false, planes = false;  // whether any of them needs the test
};

struct Geometry {
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    Motion motion;
    AlphaTest alpha_test;

    // time: Ray::time.
    SphereAt sphere_at(uint32_t i, float time) const { return {spheres, motion, i, time}; }
    InstanceAt instance_at(uint32_t i, float time) const { return {instances, motion, i, time}; }
};

// Whether the triangles exceed the caches, so that prefetching the triangles of a batch of hits pays off. Call it once
// per batch.
inline bool exceeds_caches(const Geometry& g)
{
    constexpr size_t most = 8192;
    size_t count = 0;
    for (const Mesh& m : g.meshes)
        if (count += m.triangles.size(); count > most) return true;
    return false;
}

// Computes t and uv of a hit from its primitive, in double and then rounded: the bits are the same whichever
// accelerator found it. Only (instance, geometry, primitive, kind, exit) of `hit` are read.
inline Hit refine(const Geometry& g, const Ray& ray, Hit hit)
{
    switch (hit.kind) {
        case Kind::none:
            break;
        case Kind::sphere:
            if (const auto c = crossing(*g.sphere_at(hit.primitive, ray.time), ray))
                hit.t = static_cast<float>(hit.exit ? c->exit : c->enter);
            hit.uv = {};
            break;
        case Kind::plane:
            if (const auto t = intersect(g.planes[hit.primitive], ray)) hit.t = static_cast<float>(*t);
            hit.uv = {};
            break;
        case Kind::triangle: {
            Vec3d org = to_double(ray.org), dir = to_double(ray.dir);
            if (hit.instance != Hit::no_instance) {
                const InstanceAt placed = g.instance_at(hit.instance, ray.time);
                org = placed->to_mesh.point(org);
                dir = placed->to_mesh.vector(dir);
            }
            // A triangle seen exactly edge-on has no intersection point: its first corner is used for every
            // accelerator.
            const auto h = intersect_plane_of(g.meshes[hit.geometry], hit.primitive, org, dir)
                               .value_or(TriangleHit{hit.t, 0, 0, true});
            const double u = std::clamp(h.u, 0.0, 1.0);
            hit.t = std::max(0.0f, static_cast<float>(h.t));
            hit.uv = {static_cast<float>(u), static_cast<float>(std::clamp(h.v, 0.0, 1.0 - u))};
            break;
        }
    }
    return hit;
}

// The nearest hit of a sphere or plane in [t_min, t_max] that passes the alpha test, refined.
template <Kind kind>
Hit first_opaque_hit(const Geometry& g, uint32_t primitive, const Ray& ray)
{
    static_assert(kind == Kind::sphere || kind == Kind::plane);
    const bool has_holes =
        g.alpha_test.passes_through && (kind == Kind::sphere ? g.alpha_test.spheres : g.alpha_test.planes);
    const auto stop_at = [&](double t, bool exit) {
        const Hit hit{static_cast<float>(t), Hit::no_instance, 0, primitive, {}, kind, exit};
        return reaches(ray, t) && !(has_holes && g.alpha_test.passes_through(g.alpha_test.context, ray, hit)) ? hit
                                                                                                              : Hit{};
    };
    if constexpr (kind == Kind::plane) {
        const auto t = intersect(g.planes[primitive], ray);
        return t ? stop_at(*t, false) : Hit{};
    } else {
        const auto c = crossing(*g.sphere_at(primitive, ray.time), ray);
        if (!c) return {};
        const Hit near = stop_at(c->enter, false);
        return near ? near : stop_at(c->exit, true);
    }
}

}  // namespace lancer
