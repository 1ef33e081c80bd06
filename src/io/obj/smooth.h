// Vertex normals of smoothing groups, for OBJ files that have no vn.
#pragma once

#include <cstdint>
#include <span>

#include "scene/description/description.h"

namespace lancer {

// Gives the triangles of a group one normal where they share a vertex: the mean of their normals, weighted by their
// angles there (Thuermer and Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998). groups: of each
// triangle; those of 0 stay flat. largest_deg: faces whose normals differ by more keep an edge between them; in
// [0, 180]. The mesh has no normals yet, and no triangle without area.
void smooth(MeshData& mesh, std::span<const uint32_t> groups, double largest_deg);

}  // namespace lancer
