// The pictures that a scene is made of: what must not be overwritten and what belongs to the hash of its content.
#pragma once

#include <string>
#include <vector>

#include "scene/description/description.h"

namespace lancer {

// Every file that the scene was or will be read from, each once, in the order of the description: the scene itself,
// meshes with their material files, pictures of textures and environments.
std::vector<std::string> input_files(const SceneDescription& scene);

// Takes the bytes of all meshes and of the pictures that are used into scene.content_hash. Not names but what is in the
// files counts. A picture that cannot be read counts as none; whoever wants its pixels will say so.
void hash_assets(SceneDescription& scene);

}  // namespace lancer
