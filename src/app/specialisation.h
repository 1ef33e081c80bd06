// Unused features of a render, reported by `lancer info`, --verbose and --stats.
#pragma once

#include <string>
#include <vector>

#include "render/renderer.h"

namespace lancer {

// Unused features of the scene, then those of the kernel: absent scene features, the general kernel, the OpenImageIO
// module.
std::vector<UnusedFeature> unused_features_of(const Renderer& renderer, Profile kernel);
// "12 unused materials", with the memory and time that they save, if known.
std::string to_string(const UnusedFeature& l);

}  // namespace lancer
