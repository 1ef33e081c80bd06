#include "scene/hidden_lights.h"

#include <algorithm>
#include <vector>

#include "core/frame.h"
#include "core/sampler.h"
#include "materials/material.h"
#include "scene/through_glass.h"

namespace lancer {
namespace {

constexpr uint32_t most_paths = 4096, most_vertices = 16;
constexpr uint32_t most_rays = 1u << 19;  // with many lights that nothing reaches
constexpr uint32_t most_crossed = 16;     // surfaces between a place and a light
// A light is found if of the shadow rays that only sharp surfaces may stop more than this part arrives.
constexpr double least_seen = 1.0 / 16;
constexpr uint32_t enough_seen = 8;  // arrivals that tell it

// Whether all that is sent on by a material is sharp.
bool is_sharp(const Scene& scene, uint32_t material, const ShadingPoint& point, float u)
{
    const uint32_t id = scene.scattering_material(material, point, u);
    return std::visit([&](const auto& m) { return m.at(point).only_delta(); }, scene.materials[id]);
}

class Search {
public:
    Search(const Scene& scene, const Accelerator& accel)
        : scene_(scene),
          accel_(accel),
          lights_(scene.delta_lights.size()),
          has_asked_(scene.scatters && scene.fog.medium != no_medium)  // fog samples light wherever it is
    {
        for (uint32_t i = 0; i < lights_.size(); ++i) left_.push_back(i);
    }

    void look(const Camera& camera, PictureSize size)
    {
        for (uint32_t i = 0; i < most_paths && !left_.empty() && rays_ < most_rays; ++i) {
            const Sampler sampler(SamplerKind::sobol, 0, 0, i, 0);
            const Vec2 film = sampler.get2(0, Dim::pixel);
            follow(camera.ray({film.x * static_cast<float>(size.width), film.y * static_cast<float>(size.height)},
                              sampler.get2(0, Dim::lens)),
                   sampler);
        }
    }
    std::vector<uint32_t> hidden() const
    {
        std::vector<uint32_t> all;
        if (rays_ >= most_rays) return all;  // too many to tell
        for (const uint32_t i : left_)
            if (lights_[i].stopped > 0 ? !lights_[i].is_seen() : has_hit_ && !has_asked_) all.push_back(i);
        return all;
    }

private:
    // Shadow rays that arrived, and those that would if sharp surfaces let them pass.
    struct Found {
        uint32_t arrived = 0, stopped = 0;
        bool is_seen() const { return arrived > least_seen * (arrived + stopped); }
    };

    void follow(Ray ray, const Sampler& sampler)
    {
        for (uint32_t depth = 0; depth < most_vertices && !left_.empty(); ++depth) {
            ray.key = sampler.key(depth, Dim::alpha);
            ++rays_;
            const Hit hit = accel_.closest(ray);
            if (!hit) return;
            has_hit_ = true;
            const Surface surface = surface_at(scene_, ray, hit);
            if (is_bare(surface)) has_asked_ = true;  // light is sampled inside
            const ShadingPoint point = scene_.shading_point(surface);
            const uint32_t id = scene_.scattering_material(surface.material, point, sampler.get1(depth, Dim::mix));
            const Frame frame(surface.ns);
            const Vec3 wo = frame.to_local(-ray.dir);
            const auto next = std::visit(
                [&](const auto& material) {
                    const auto bsdf = material.at(point);
                    if (!bsdf.only_delta()) ask(surface, bsdf.transmits(), sampler.key(depth, Dim::shadow_alpha));
                    return bsdf.sample(wo, sampler.get1(depth, Dim::bsdf), sampler.get2(depth, Dim::bsdf));
                },
                scene_.materials[id]);
            if (!next || is_black(next->weight)) return;
            const Vec3 wi = normalize(frame.to_world(next->wi));
            if ((dot(wi, surface.side) < 0) != (next->wi.z < 0)) return;
            ray = {.org = ray_origin(surface, wi), .dir = wi};
            if (!is_traceable(ray)) return;
        }
    }
    // Whether shadow rays pass the surface of a body: see Medium::is_bare.
    bool is_bare(const Surface& surface) const
    {
        const uint16_t medium = scene_.media.empty() ? no_medium : scene_.traits[surface.material].medium;
        return medium != no_medium && scene_.media[medium].is_bare;
    }
    // Shadow rays from a surface to all lights that are left.
    void ask(const Surface& from, bool transmits, uint32_t key)
    {
        has_asked_ = true;
        std::erase_if(left_, [&](uint32_t i) {
            const auto light = std::visit([&](const auto& l) { return l.sample(from.p); }, scene_.delta_lights[i]);
            if (!light || (!transmits && dot(light->wi, from.side) <= 0)) return false;
            Found& found = lights_[i];
            switch (way_to(from, *light, key)) {
                case Way::open:
                    ++found.arrived;
                    break;
                case Way::through_sharp:
                    ++found.stopped;
                    break;
                case Way::closed:
                    break;
            }
            return found.arrived >= enough_seen && found.is_seen();
        });
    }
    enum class Way { open, through_sharp, closed };
    Way way_to(const Surface& from, const LightSample& light, uint32_t key)
    {
        Way way = Way::open;
        Ray ray{.org = ray_origin(from, light.wi), .dir = light.wi, .key = key};
        for (uint32_t i = 0; i < most_crossed; ++i) {
            if (!light.infinite) {
                const Vec3 rest = light.point - ray.org;
                ray.t_max = length(rest);
                if (dot(rest, light.wi) <= 0) return way;  // the light is on the surface itself
                ray.dir = rest / ray.t_max;
            }
            if (!is_traceable(ray)) return Way::closed;
            ++rays_;
            const Hit hit = accel_.closest(ray);
            if (!hit) return way;
            const Surface met = surface_at(scene_, ray, hit);
            if (is_bare(met) || !is_black(through_glass(scene_, ray, met))) {
                ray.org = ray_origin(met, ray.dir);
                continue;
            }
            if (!is_sharp(scene_, met.material, scene_.shading_point(met), 0.5f)) return Way::closed;
            way = Way::through_sharp;
            ray.org = ray_origin(met, ray.dir);
        }
        return Way::closed;
    }

    const Scene& scene_;
    const Accelerator& accel_;
    std::vector<Found> lights_;
    std::vector<uint32_t> left_;  // lights that no shadow ray has reached
    uint32_t rays_ = 0;
    bool has_asked_, has_hit_ = false;
};

bool has_sharp_materials(const Scene& scene)
{
    const ShadingPoint nowhere{.textures = scene.textures.data()};
    for (uint32_t id = 0; id < scene.materials.size(); ++id)
        if (scene.traits[id].mirrors && is_sharp(scene, id, nowhere, 0.5f)) return true;
    return false;
}

// The descriptions of Scene::delta_lights.
template <class... L>
std::vector<const LightDescription*> described(const SceneDescription& d, std::type_identity<std::variant<L...>>)
{
    std::vector<const LightDescription*> all;
    const auto add = [&](LightType type) {
        for (const LightDescription& l : d.lights)
            if (l.type == type && !is_black(l.power)) all.push_back(&l);
    };
    (add(L::type), ...);
    return all;
}

}  // namespace

uint32_t warn_of_hidden_lights(const SceneDescription& description, const Scene& scene, const Accelerator& accel,
                               const Camera& camera, PictureSize size, Diagnostics& problems)
{
    if (scene.delta_lights.empty() || !has_sharp_materials(scene)) return 0;
    Search search(scene, accel);
    search.look(camera, size);
    const std::vector<uint32_t> hidden = search.hidden();
    const auto lights = described(description, std::type_identity<DeltaLight>{});
    for (const uint32_t i : hidden)
        problems.warning(lights[i]->where,
                         "this " + std::string(name_of(lights[i]->type)) +
                             " light does not reach the picture, or hardly: smooth glass or mirrors are between it and "
                             "what is seen, and only rays that meet a light go through these; a sphere or a surface "
                             "that emits can be met, and with straight_shadows light goes straight through glass");
    return static_cast<uint32_t>(hidden.size());
}

}  // namespace lancer
