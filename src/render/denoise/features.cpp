#include "render/denoise/features.h"

#include "core/frame.h"
#include "integrators/path/transport.h"
#include "materials/material.h"
#include "render/aov.h"

namespace lancer {
namespace {

// A ray that ends at a surface, and what it counts.
struct Sight {
    Ray ray;
    RayCone cone;
    Color tint{1, 1, 1};    // of the mirrors and glass so far
    float weight = 1;       // part of the light's ways that it stands for
    float distance = 0;     // from the camera to the ray's origin
    uint32_t surfaces = 0;  // that it met before
};

// Ways of less weight, and longer ones, end at the mirror or glass that they have reached.
constexpr float least_weight_followed = 0.1f;
constexpr uint32_t most_surfaces = 12;

class Sights {
public:
    Sights(const Scene& scene, const Accelerator& accel) : scene_(scene), accel_(accel) {}

    void look(const Sight& sight)
    {
        if (const Hit hit = accel_.closest(sight.ray)) meet(sight, surface_at(scene_, sight.ray, hit, sight.cone));
    }
    void meet(const Sight& sight, const Surface& surface)
    {
        const ShadingPoint point = scene_.shading_point(surface);
        const bool is_mix = !scene_.mix_of.empty() && scene_.mix_of[surface.material] != Scene::none;
        const bool goes_on = !is_mix && !is_cloudy(surface) && sight.surfaces < most_surfaces &&
                             sight.weight >= least_weight_followed &&
                             std::visit([&](const auto& m) { return follow(sight, surface, m.at(point)); },
                                        scene_.materials[surface.material]);
        if (goes_on) return;
        const Color albedo = sight.tint * albedo_at(scene_, surface.material, point);
        const std::array values{
            albedo.r, albedo.g, albedo.b, surface.ns.x, surface.ns.y, surface.ns.z, 1 / (sight.distance + surface.t)};
        for (size_t i = 0; i < values.size(); ++i) seen_[i] += sight.weight * values[i];
    }
    const SampleSet::Features& seen() const { return seen_; }

private:
    // Whether what is inside of a body hides what is behind it.
    bool is_cloudy(const Surface& surface) const
    {
        const uint16_t medium = scene_.traits[surface.material].medium;
        return scene_.scatters && medium != no_medium && scene_.media[medium].scatters();
    }
    // Follows the ways on from a mirror or smooth glass. False where light is spread.
    template <class B>
    bool follow(const Sight& sight, const Surface& surface, const B& bsdf)
    {
        if (!bsdf.only_delta()) return false;
        const Frame frame(surface.ns);
        const Vec3 wo = frame.to_local(-sight.ray.dir);
        // The first number selects reflection, the last one refraction where there is any; see GlassBsdf::sample().
        constexpr float last = 1 - 0x1p-24f;
        const auto reflected = bsdf.sample(wo, 0, {}), refracted = bsdf.sample(wo, last, {});
        send(sight, surface, frame, reflected);
        if (refracted && !(reflected && refracted->wi == reflected->wi)) send(sight, surface, frame, refracted);
        return true;
    }
    void send(const Sight& from, const Surface& surface, const Frame& frame, const std::optional<BsdfSample>& b)
    {
        if (!b) return;
        const Vec3 wi = normalize(frame.to_world(b->wi));
        const float to_energy = b->eta * b->eta;
        const Sight next{.ray = {.org = ray_origin(surface, wi),
                                 .dir = wi,
                                 .key = from.ray.key,
                                 .leaf_hint = surface.leaf_hint,
                                 .time = from.ray.time},
                         .cone = scattered(from.cone, surface.t, *b),
                         .tint = from.tint * (b->weight * to_energy),
                         .weight = from.weight * b->pdf,
                         .distance = from.distance + surface.t,
                         .surfaces = from.surfaces + 1};
        if (is_traceable(next.ray)) look(next);
    }

    const Scene& scene_;
    const Accelerator& accel_;
    SampleSet::Features seen_{};
};

}  // namespace

SampleSet::Features features_seen(const Scene& scene, const Accelerator& accel, const PathState& s,
                                  const Surface& surface)
{
    Sights sights(scene, accel);
    sights.meet({.ray = s.ray, .cone = s.cone}, surface);
    return sights.seen();
}

}  // namespace lancer
