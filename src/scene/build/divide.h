// Divides the triangles of a mesh, so that it can be displaced: edges are halved at their middles, round by round.
#pragma once

#include <cstdint>
#include <functional>

#include "scene/description/description.h"

namespace lancer {

// A mesh all of whose triangles have normals, and that says which corners were one.
struct DividedMesh {
    MeshData data;        // triangles, normals, texture coordinates, colours and face materials; no tangents
    uint32_t levels = 0;  // rounds that changed something
};

// How many edges of each triangle are halved is decided by its edges alone, and an edge by the places of its ends. So
// triangles that share an edge, or have edges in the same place, agree on it: no round opens a crack.
// is_long(a, b, round): whether an edge is halved in a round; the same for both orders of its ends. check(triangles):
// called with the number of triangles before room is made for them; may throw. Flat triangles get the normal of their
// plane. Middles of normals are unit.
DividedMesh divide(const MeshData& mesh, uint32_t most_rounds,
                   const std::function<bool(Vec3d a, Vec3d b, uint32_t round)>& is_long,
                   const std::function<void(uint64_t triangles)>& check);

}  // namespace lancer
