// Shading normals at the corners of a mesh's triangles. If each vertex has a single normal, the normals are stored
// behind the positions of the mesh, which saves two memory accesses when shading.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/vec.h"
#include "geometry/shapes.h"
#include "scene/description/description.h"

namespace lancer {

struct CornerNormals {
    using Corners = std::array<uint32_t, 3>;
    static constexpr uint32_t none = MeshData::no_normal;

    std::vector<Vec3> values;        // unit; padded by one entry, as four numbers are read at a time
    std::vector<Corners> triangles;  // normal indices of each triangle, `none` for a flat one
    bool are_of_vertices = false;    // normals are stored with the vertices: both arrays are empty, and Mesh::rows is 2

    // Value of the normal of a vertex whose triangles are flat.
    static constexpr Vec3 of_flat()
    {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        return {nan, nan, nan};
    }

    bool empty() const { return values.empty() && !are_of_vertices; }
    // Normal indices of a triangle, if it has any. The object must not be empty().
    const Corners& named_by(const Mesh& mesh, uint32_t triangle) const
    {
        return are_of_vertices ? mesh.triangles[triangle] : triangles[triangle];
    }
    // The normal with an index from named_by().
    const Vec3& value(const Mesh& mesh, uint32_t named) const
    {
        return are_of_vertices ? mesh.positions[named + 1] : values[named];
    }
    // The normals of a triangle's corners; null if it is flat.
    const Corners* find(const Mesh& mesh, uint32_t triangle) const
    {
        if (empty()) return nullptr;
        const Corners& c = named_by(mesh, triangle);
        const bool flat = are_of_vertices ? std::isnan(value(mesh, c[0]).x) : c[0] == none;
        return flat ? nullptr : &c;
    }
    uint64_t bytes() const { return values.size() * sizeof(Vec3) + triangles.size() * sizeof(Corners); }
};

}  // namespace lancer
