// Vertex normals of smoothing groups, for OBJ files that have no vn.
#pragma once

#include <cstdint>
#include <span>

#include "scene/description/description.h"

namespace lancer {

// Faces that meet at a larger angle than this, between their normals, stay an edge.
inline constexpr double largest_smooth_deg = 70;

// Gives the triangles of a group one normal where they share a vertex: the mean of their normals, weighted by their
// angles there (Thuermer and Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998). groups: of each
// triangle; those of 0 stay flat. The mesh has no normals yet, and no triangle without area.
void smooth(MeshData& mesh, std::span<const uint32_t> groups);

}  // namespace lancer
