#include "app/view/pick.h"

#include "app/view/camera_moves.h"
#include "scene/camera.h"

namespace lancer {
namespace {

// Spheres of the scene are those of the description, then its sphere lights that shine.
std::optional<size_t> light_of_sphere(const SceneDescription& scene, size_t sphere)
{
    size_t index = scene.spheres.size();
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const LightDescription& l = scene.lights[i];
        if (l.type == LightType::sphere && !is_black(l.power) && index++ == sphere) return i;
    }
    return {};
}

}  // namespace

std::optional<Picked> pick(const Renderer& renderer, const SceneDescription& description,
                           const CameraDescription& camera, PictureSize size, double x, double y)
{
    const Scene& scene = renderer.scene();
    const Camera eye(camera, scene.normalisation, size.width, size.height);
    const Ray ray = eye.middle_ray({static_cast<float>(x), static_cast<float>(y)});
    const Hit hit = renderer.accelerator().closest(ray);
    if (!hit) return {};
    Picked p;
    p.point = scene.normalisation.to_file(to_double(ray.org) + to_double(ray.dir) * double{hit.t});
    p.depth = depth_of(camera, p.point);
    p.material = scene.material_names[scene.material_of(hit)];
    switch (hit.kind) {
        case Kind::none:
            break;
        case Kind::triangle:
            p.object = scene.mesh_names[hit.geometry];
            break;
        case Kind::plane:
            p.object = "plane " + std::to_string(hit.primitive);
            break;
        case Kind::sphere:
            p.object = "sphere " + std::to_string(hit.primitive);
            if (hit.primitive < description.spheres.size()) p.sphere = hit.primitive;
            p.light = light_of_sphere(description, hit.primitive);
            if (p.light) p.object = "light " + std::to_string(*p.light);
            break;
    }
    return p;
}

}  // namespace lancer
