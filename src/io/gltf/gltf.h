// glTF 2.0 files (.gltf, .glb): Khronos Group, "glTF 2.0 Specification", 2021, with the extensions that
// docs/scene-format.md lists.
#pragma once

#include <memory>
#include <string>

#include "io/mesh_options.h"
#include "io/toml_value.h"
#include "scene/description/description.h"

namespace lancer {

// The meshes of the default scene as one, each where its nodes place it, with their materials. Triangles keep the order
// of nodes, primitives and indices; those without area are dropped with a warning. Buffers are read at once, and their
// numbers by all threads. What is not understood is left out with a warning. Returns null after adding an error.
std::shared_ptr<const MeshData> load_gltf(const std::string& path, Diagnostics& diagnostics,
                                          const MeshOptions& options = {});

// The cameras and lights of the default scene as tables of a scene file, "camera" and "light". Throws Error for what is
// no glTF file.
TomlValue::Table gltf_tables(const std::string& path, Diagnostics& diagnostics);

}  // namespace lancer
