// All that an integrator can see of a scene. No accelerator: rays are asked for through Steps.
#pragma once

#include <utility>

#include "core/sampler.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace lancer {

struct View {
    const Scene& scene;

    Surface surface_at(const Ray& ray, const Hit& hit) const { return lancer::surface_at(scene, ray, hit); }

    // f gets the concrete material, so that all it calls on it is inlined. The one dispatch per hit.
    template <class F>
    auto with_material(uint32_t id, F&& f) const
    {
        return std::visit(std::forward<F>(f), scene.materials[id]);
    }
    Color emission(const Surface& s) const { return scene.emission[s.material].towards(s.front); }
    // Radiance of a ray that left the scene.
    Color environment(Vec3) const { return scene.environment; }

    std::optional<LightSample> sample_light(const Surface& from, const Sampler& sampler, uint32_t bounce) const
    {
        if (scene.lights.pick.empty()) return {};
        const float pick = scene.lights.pick.size() > 1 ? sampler.get1(bounce, Dim::light) : 0;
        return lancer::sample_light(scene, from, pick, sampler.get2(bounce, Dim::light));
    }
    float pdf_light(Vec3 from, Vec3 wi, const Surface& at) const { return lancer::pdf_light(scene, from, wi, at); }
    float pdf_environment(Vec3 normal, Vec3 wi) const { return lancer::pdf_environment(scene, normal, wi); }
};

}  // namespace lancer
