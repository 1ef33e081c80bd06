#include "scene/build/media.h"

#include <algorithm>
#include <limits>

#include "core/names.h"
#include "materials/material.h"

namespace lancer {

bool matters(const Medium& m) { return m.priority || !is_black(m.absorption); }

namespace {

// Of the medium inside, or nothing. A material that lists what a medium is must say its index.
std::optional<float> medium_ior(const Material& bsdf, bool has_priority)
{
    return std::visit(
        [&]<class M>(const M& m) -> std::optional<float> {
            constexpr bool has_inside =
                index_of_key(M::parameters, "absorption") < std::tuple_size_v<decltype(M::parameters)>;
            if constexpr (has_inside) return m.medium_ior(has_priority);
            return {};
        },
        bsdf);
}

}  // namespace

uint16_t add_medium(const MaterialDescription& m, const Material& bsdf, Scene& scene, Diagnostics& diagnostics)
{
    const std::optional<float> ior = medium_ior(bsdf, m.priority.has_value());
    if (m.thin.value_or(false) && (m.priority || !is_black(m.absorption)))
        diagnostics.error(m.where, "material " + in_quotes(m.name) + " is thin and has " +
                                       (m.priority ? "a 'priority'" : "'absorption'") + ": a sheet has no inside");
    if (!ior) return no_medium;
    const auto per_scene_unit = [&](float sigma) {
        return std::min(sigma / static_cast<float>(scene.normalisation.scale), std::numeric_limits<float>::max());
    };
    Medium medium{
        .absorption = {per_scene_unit(m.absorption.r), per_scene_unit(m.absorption.g), per_scene_unit(m.absorption.b)},
        .priority = m.priority};
    medium.ior = *ior;
    const auto refuse = [&](const char* why) {
        diagnostics.error(m.where, "material " + in_quotes(m.name) + " has " +
                                       (medium.priority ? "a 'priority'" : "'absorption'") + " and " + why);
    };
    if (matters(medium) && (m.opacity < 1 || m.opacity_map))
        refuse("an opacity: what goes through a hole would neither enter nor leave");
    if (medium.priority && !is_black(m.emission)) refuse("emission: it would shine where its surface is not there");
    if (scene.media.size() == no_medium) {
        diagnostics.error(m.where, "more than 65535 transparent materials");
        return no_medium;
    }
    scene.media.push_back(medium);
    return static_cast<uint16_t>(scene.media.size() - 1);
}

void finish_media(Scene& scene)
{
    if (!scene.legacy && std::any_of(scene.media.begin(), scene.media.end(), matters)) return;
    scene.media.clear();
    scene.camera_media = {};
    for (MaterialTraits& traits : scene.traits) traits.medium = no_medium;
}

}  // namespace lancer
