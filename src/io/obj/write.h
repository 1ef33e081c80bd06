// A mesh as the plainest OBJ file there is, for readers that know only v, vt, vn, usemtl and f with three corners.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "io/atomic_file.h"
#include "scene/description/description.h"

namespace lancer {

// Positions in the units of the mesh with digits that give the very same double back. Triangles in their order, each
// run of one material after "usemtl mN"; N: material_of the triangle, which is left out if it has none. Corners run
// counter-clockwise seen from the side of the normals, which say which side is the front. with_uvs: with texture
// coordinates, where there are any. Throws Error (failed) if it cannot be written; the caller commits.
void write_obj(AtomicFile& file, const MeshData& mesh, bool with_uvs,
               const std::function<std::optional<uint32_t>(uint32_t)>& material_of);

}  // namespace lancer
