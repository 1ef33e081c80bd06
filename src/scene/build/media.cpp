#include "scene/build/media.h"

#include <algorithm>
#include <limits>

#include "core/names.h"

namespace lancer {

bool matters(const Medium& m) { return m.priority || !is_black(m.absorption); }

uint16_t add_medium(const MaterialDescription& m, Scene& scene, Diagnostics& diagnostics)
{
    const bool is_interface = m.type == MaterialType::interface && m.phong.refraction > 0;
    if (m.type != MaterialType::glass && !is_interface) return no_medium;
    const auto per_scene_unit = [&](float sigma) {
        return std::min(sigma / static_cast<float>(scene.normalisation.scale), std::numeric_limits<float>::max());
    };
    Medium medium{
        .absorption = {per_scene_unit(m.absorption.r), per_scene_unit(m.absorption.g), per_scene_unit(m.absorption.b)},
        .priority = m.priority};
    // What has a priority knows what it touches, and needs no second index.
    medium.ior = !is_interface ? m.ior : m.phong.inside_ior / (m.priority ? 1 : m.phong.outside_ior);
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
