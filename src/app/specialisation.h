// What a render does without, told by `lancer info`, --verbose and --stats.
#pragma once

#include <string>
#include <vector>

#include "render/renderer.h"

namespace lancer {

// What building the scene left out, then what tracing it with this kernel does: kinds of geometry, the kernel for all,
// and the module for pictures.
std::vector<UnusedFeature> unused_features_of(const Renderer& renderer, Profile kernel);
// "12 unused materials", with the memory that it saves where that is known.
std::string to_string(const UnusedFeature& l);

}  // namespace lancer
