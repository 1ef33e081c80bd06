// Groups of lights while a scene is built.
#pragma once

#include <string>

#include "core/error.h"
#include "scene/scene.h"

namespace lancer {

// The index of a group that something names; empty: of the rest. Too many groups are an error.
inline uint8_t light_group(Scene& scene, const std::string& name, const Location& where, Diagnostics& diagnostics)
{
    const uint8_t index = scene.light_groups.index_of(name);
    if (scene.light_groups.names.size() > LightGroups::most) {
        scene.light_groups.names.pop_back();
        diagnostics.error(where, "more than " + std::to_string(LightGroups::most - 1) + " groups of lights");
        return 0;
    }
    return index;
}

}  // namespace lancer
