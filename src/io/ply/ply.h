// Polygon files (.ply): Turk, "The PLY Polygon File Format", 1994; names of properties as scanners and Blender, MeshLab
// and CloudCompare write them.
#pragma once

#include <memory>
#include <string>

#include "io/mesh_options.h"
#include "scene/description/description.h"

namespace lancer {

// Text and binary files in either byte order. Of vertices: x y z, nx ny nz, red green blue, u v (also s t and texture_u
// texture_v); of faces: their lists of vertices, also as triangle strips, and lists of texture coordinates. All else is
// skipped. Polygons are triangulated as those of OBJ files are; triangles keep the order of the file, and faces without
// area are dropped with a warning. There are no materials: the default grey, or that of the scene. Large binary files
// are read by all threads. Returns null after adding an error.
std::shared_ptr<const MeshData> load_ply(const std::string& path, Diagnostics& diagnostics,
                                         const MeshOptions& options = {});

}  // namespace lancer
