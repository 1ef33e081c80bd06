// What [[plane]], [[water]], [[bubble]], [[triangle]] and [[pyramid]] mean: fills the shapes of a SceneDescription.
#pragma once

#include <vector>

#include "io/scene/material_tables.h"
#include "io/toml_reader.h"
#include "scene/description/description.h"

namespace lancer {

// What is a mesh comes after those of scene.meshes. Returns the materials that shapes name.
std::vector<NameUse> read_shapes(const TomlTable& root, SceneDescription& scene);

// The material that a table names, or "".
std::string read_material_use(const TomlTable& table, std::vector<NameUse>& uses, std::string_view key = "material");

}  // namespace lancer
