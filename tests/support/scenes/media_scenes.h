// Scenes with media: bodies that overlap, and light that is absorbed in them.
#pragma once

#include "support/scenes/scenes.h"

namespace lancer {

MaterialDescription make_medium(std::string name, float ior, Color absorption, std::optional<int32_t> priority = {});

// Glass around a medium that scatters.
MaterialDescription make_scattering(std::string name, float ior, Color scattering, Color absorption = {},
                                    float anisotropy = 0);
// Without a box.
FogDescription fog_of(Color scattering, Color absorption = {}, float anisotropy = 0);

SceneDescription scattering_scene();
SceneDescription fog_scene();
SceneDescription fog_between_points();

}  // namespace lancer
