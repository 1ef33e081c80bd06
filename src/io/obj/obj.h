// Wavefront OBJ with its MTL files. Called by the scene loader and for OBJ files given on the command line.
#pragma once

#include <memory>
#include <string>

#include "io/mesh_options.h"
#include "scene/description/description.h"

namespace lancer {

// Everything in the result is checked; see MeshData. Polygons are triangulated and triangles keep the order of the
// file; vertices are not merged. Faces without area, points and lines are dropped with a warning; a material or
// material file that does not exist becomes a grey one with a warning. Texture coordinates are kept only if a material
// in use reads a texture or the options ask for them. Returns null after adding an error.
std::shared_ptr<const MeshData> load_obj(const std::string& path, Diagnostics& diagnostics,
                                         const MeshOptions& options = {});

}  // namespace lancer
