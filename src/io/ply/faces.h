// The faces of a PLY file.
#pragma once

#include "io/ply/values.h"
#include "scene/description/description.h"

namespace lancer {

// Reads the element at the cursor into the triangles of a mesh whose vertices are complete, and into uvs and
// uv_triangles if faces have texture coordinates of their own, which come before those of vertices. Strips: lists of
// triangle strips, which -1 separates. False after adding an error.
bool read_ply_faces(const PlyElement& element, bool are_strips, bool swaps, bool keeps_uvs, PlyCursor& cursor,
                    MeshData& mesh, Diagnostics& diagnostics);

}  // namespace lancer
