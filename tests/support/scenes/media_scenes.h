// Scenes with media: bodies that overlap, and light that is absorbed in them.
#pragma once

#include "support/scenes/scenes.h"

namespace lancer {

MaterialDescription make_medium(std::string name, float ior, Color absorption, std::optional<int32_t> priority = {});

}  // namespace lancer
