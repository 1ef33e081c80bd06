// Tangents at the corners of the triangles of a mesh, of those triangles alone whose material reads them.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/corner_table.h"
#include "scene/description/description.h"

namespace lancer {

struct CornerTangents {
    std::vector<MeshTangent> values;  // in the space of the mesh's positions
    CornerTable triangles;            // indices of the tangents of each triangle's corners

    bool empty() const { return values.empty(); }
    uint64_t bytes() const { return values.size() * sizeof(MeshTangent) + triangles.bytes(); }
};

}  // namespace lancer
