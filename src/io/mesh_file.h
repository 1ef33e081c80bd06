// Mesh files of any format that there is a reader for.
#pragma once

#include <memory>
#include <string>

#include "io/mesh_options.h"
#include "scene/description/description.h"

namespace lancer {

// By load_ply() for a name that ends in .ply, by load_gltf() for .gltf and .glb, else by load_obj(). Returns null after
// adding an error.
std::shared_ptr<const MeshData> load_mesh(const std::string& path, Diagnostics& diagnostics,
                                          const MeshOptions& options = {});

}  // namespace lancer
