#include "scene/through_glass.h"

#include <algorithm>

#include "core/frame.h"
#include "materials/material.h"
#include "scene/scene.h"

namespace lancer {
namespace {

bool lets_pass(const Scene& scene, const Glass& glass) { return glass.thin || scene.straight_shadows; }

}  // namespace

Color through_glass(const Scene& scene, const Ray& ray, const Surface& surface)
{
    if (!scene.mix_of.empty() && scene.mix_of[surface.material] != Scene::none) return {};
    const auto* const glass = std::get_if<Glass>(&scene.materials[surface.material]);
    if (!glass || !lets_pass(scene, *glass)) return {};
    const GlassBsdf bsdf = glass->at(scene.shading_point(surface));
    return bsdf.only_delta() ? bsdf.straight_on(Frame(surface.ns).to_local(-ray.dir)) : Color{};
}

bool lights_pass_glass(const Scene& scene)
{
    if (scene.legacy || (scene.lights.deltas == 0 && scene.soft_shadows)) return false;
    return std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& any) {
        const auto* const glass = std::get_if<Glass>(&any);
        return glass && lets_pass(scene, *glass);
    });
}

}  // namespace lancer
