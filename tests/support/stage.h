// A scene with both accelerators around it, to trace single rays.
#pragma once

#include "core/ray.h"
#include "geometry/embree/embree.h"
#include "geometry/list/list.h"
#include "scene/alpha_test.h"
#include "scene/surface.h"
#include "support/scenes/scenes.h"

namespace lancer {

struct Stage {
    Scene scene;
    List list{scene.geometry};
    std::unique_ptr<Accelerator> embree;

    explicit Stage(const SceneDescription& d, const RasterSource& images = test_picture) : scene(build_scene(d, images))
    {
        bind_alpha_test(scene);
        embree = make_embree(scene.geometry, "avx2");
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    Vec3 to_scene(Vec3d file) const { return lancer::to_float(scene.normalisation.to_scene(file)); }
    // Where the ray ends, by the list.
    std::optional<Surface> look(Vec3 org, Vec3 dir) const
    {
        const Ray ray{.org = org, .dir = normalize(dir)};
        const Hit hit = list.closest(ray);
        if (!hit) return {};
        return surface_at(scene, ray, hit);
    }
};

// A receiver for light sampling that belongs to no object: a place with a normal, its rounding that of a float.
inline Surface receiver(Vec3 p, Vec3 n)
{
    return {.p = p,
            .p_error = abs(p) * gamma(1),
            .n = n,
            .ns = n,
            .origin = offset_origin(p, abs(p) * gamma(1), n, n),
            .side = n,
            .front = true,
            .material = 0,
            .light = Scene::none,
            .t = 1};
}

inline MeshDescription triangle_mesh(Vec3d a, Vec3d b, Vec3d c, MaterialDescription material)
{
    return make_mesh(make_mesh_data({a, b, c}, {{0, 1, 2}}, std::move(material)));
}

}  // namespace lancer
