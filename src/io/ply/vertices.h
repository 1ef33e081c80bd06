// The vertices of a PLY file.
#pragma once

#include <array>
#include <string>

#include "io/ply/values.h"
#include "scene/description/description.h"

namespace lancer {

// Reads the element at the cursor into positions, normals (of those that are no direction zero), uvs (likewise
// infinite), colors and alphas (none where all are 1) of the mesh, which stay empty if the file has none. keeps_uvs:
// whether uvs are wanted. False after adding an error.
bool read_ply_vertices(const PlyElement& element, bool swaps, bool keeps_uvs, PlyCursor& cursor, MeshData& mesh,
                       Diagnostics& diagnostics);

}  // namespace lancer
