// The files of a scene: they must not be overwritten, and they are part of the hash of its content.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scene/description/description.h"

namespace lancer {

// Every file that the scene was or will be read from, each once, in the order of the description: the scene itself,
// meshes with their material files, pictures of textures and environments.
std::vector<std::string> input_files(const SceneDescription& scene);

// Adds the bytes of all meshes and used pictures to scene.content_hash. File contents count, not names. A picture that
// cannot be read counts as missing; reading its pixels reports the error. known: of files that are not read again.
using FileHashes = std::map<std::string, uint64_t>;
void hash_assets(SceneDescription& scene, FileHashes* known = nullptr);

}  // namespace lancer
