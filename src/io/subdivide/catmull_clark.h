// Meshes subdivided by the scheme of Catmull and Clark.
#pragma once

#include "scene/description/description.h"

namespace lancer {

// Each face becomes quads, `levels` times, and each quad two triangles; all are smooth. Two triangles in a row that are
// how a quad is divided, (a, b, c) and (a, c, d), count as one, other triangles as what they are. Vertices in the same
// place are one; texture coordinates keep their seams, and boundaries their corners. levels: 1 or more. Throws Error
// (failed) if the module that does it is not there or refuses the mesh, (no_memory) if more than 2^28 faces would be
// made.
MeshData catmull_clark(const MeshData& mesh, uint32_t levels, const Location& where);

}  // namespace lancer
