// Meshes made by formulas, of any size: what can be measured without a file, and how speed goes with size.
#pragma once

#include <cstdint>
#include <memory>

#include "scene/description/description.h"

namespace lancer::bench {

using MeshPointer = std::shared_ptr<const MeshData>;

// Each has about `triangles` triangles, within one row of its grid.
MeshPointer make_displaced_sphere(uint64_t triangles);  // closed, bulges and dents a fifth of its radius deep
MeshPointer make_terrain(uint64_t triangles);           // hills over a square
MeshPointer make_room(uint64_t triangles);              // a closed room with hundreds of balls in it

// Each triangle in four, level by level; the surface stays where it is.
MeshPointer subdivide(const MeshData& mesh, unsigned levels);

}  // namespace lancer::bench
