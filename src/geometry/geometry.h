// All that rays can hit, as plain arrays: what an accelerator is built from. Shading data lives elsewhere.
#pragma once

#include <vector>

#include "geometry/hit.h"
#include "geometry/shapes.h"

namespace lancer {

struct Geometry;

// Surfaces with holes: cut-outs and what stops only a part of the rays. Accelerators ask at every hit of a primitive
// that is marked; a function pointer, so that nothing of shading is known here.
struct AlphaTest {
    // Whether the ray goes through the surface at the hit, of which t and uv are refined. The same (ray.key, primitive,
    // side of a sphere) gets the same answer, however often and in whatever order it is asked; ray.t_max, which
    // shortens while accelerators search, has no part in it. Null: nothing has holes.
    bool (*passes_through)(const void* context, const Ray& ray, const Hit& hit) = nullptr;
    const void* context = nullptr;
    // Parallel to Geometry::meshes: of each triangle whether to ask; empty where a mesh has none that is to be asked
    // about. Most of a mesh with a few leaves in it then costs next to nothing.
    std::vector<std::vector<uint8_t>> meshes;
    bool spheres = false, planes = false;  // whether any is
};

struct Geometry {
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    AlphaTest alpha_test;
};

// Whether there are more triangles than the caches next to the processor hold, so that it pays to ask for those that
// were hit before they are looked at. For a batch, not for each ray.
inline bool exceeds_caches(const Geometry& g)
{
    constexpr size_t most = 8192;
    size_t count = 0;
    for (const Mesh& m : g.meshes)
        if (count += m.triangles.size(); count > most) return true;
    return false;
}

// t and uv of a hit from its primitive alone, in double and then rounded: the same bits whichever accelerator found
// it. Only (instance, geometry, primitive, kind, exit) of `hit` are read.
inline Hit refine(const Geometry& g, const Ray& ray, Hit hit)
{
    switch (hit.kind) {
        case Kind::none:
            break;
        case Kind::sphere:
            if (const auto c = crossing(g.spheres[hit.primitive], ray))
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
                const Transform& m = g.instances[hit.instance].to_mesh;
                org = m.point(org);
                dir = m.vector(dir);
            }
            // Seen exactly from its edge the triangle has no such place: its first corner, whichever accelerator says
            // so.
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

// Where a sphere or plane stops a ray: its nearest hit, refined, in [t_min, t_max] that does not let the ray pass.
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
        const auto c = crossing(g.spheres[primitive], ray);
        if (!c) return {};
        const Hit near = stop_at(c->enter, false);
        return near ? near : stop_at(c->exit, true);
    }
}

}  // namespace lancer
