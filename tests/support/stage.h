// A scene with both accelerators around it, to trace single rays.
#pragma once

#include "core/ray.h"
#include "geometry/embree.h"
#include "geometry/list.h"
#include "scene/surface.h"
#include "support/scenes.h"

namespace lancer {

struct Stage {
    Scene scene;
    List list{scene.geometry};
    std::unique_ptr<Accelerator> embree = make_embree(scene.geometry, "avx2");

    explicit Stage(const SceneDescription& d) : scene(build_scene(d)) {}
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

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
            .front = true,
            .material = 0,
            .light = Scene::none,
            .t = 1};
}

inline MeshDescription triangle_mesh(Vec3d a, Vec3d b, Vec3d c, MaterialDescription material)
{
    return make_mesh(make_mesh_data({a, b, c}, {{0, 1, 2}}, std::move(material)));
}

inline SphereDescription sphere_of(Vec3d center, double radius, std::string material = {}, Location where = {})
{
    SphereDescription s;
    s.where = std::move(where);
    s.center = center;
    s.radius = radius;
    s.material = std::move(material);
    return s;
}
inline PlaneDescription plane_of(Vec3d point, Vec3d normal, std::string material = {}, Location where = {})
{
    PlaneDescription p;
    p.where = std::move(where);
    p.point = point;
    p.normal = normal;
    p.material = std::move(material);
    return p;
}
inline LightDescription light_of(LightType type, Color power, Vec3d position = {}, double radius = 1,
                                 Location where = {})
{
    LightDescription l;
    l.where = std::move(where);
    l.type = type;
    l.position = position;
    l.radius = radius;
    l.power = power;
    return l;
}
inline LightDescription sky_of(Color radiance) { return light_of(LightType::environment, radiance); }
inline InstanceDescription instance_of(std::string mesh, TransformDescription transform, Location where = {})
{
    InstanceDescription i;
    i.where = std::move(where);
    i.mesh = std::move(mesh);
    i.transform = transform;
    return i;
}

}  // namespace lancer
