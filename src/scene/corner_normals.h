// Shading normals at the corners of a mesh's triangles. If each vertex has a single normal, the normals are stored
// behind the positions of the mesh, which saves two memory accesses when shading.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/lanes/memory.h"
#include "core/vec.h"
#include "geometry/shapes.h"
#include "scene/description/description.h"

namespace lancer {

struct CornerNormals {
    using Corners = std::array<uint32_t, 3>;
    static constexpr uint32_t none = MeshData::no_normal;

    // Where they stand: in `values`; behind the positions of their vertices, where Mesh::rows is 2; or the same in
    // 32 bits, in `codes`. Those of vertices are odd.
    enum class Storage : uint8_t { none, vertices, corners, vertex_codes, corner_codes };

    std::vector<Vec3> values;        // unit; padded by one entry, as four numbers are read at a time
    std::vector<Corners> triangles;  // normal indices of each triangle, `none` for a flat one; empty for those of
                                     // vertices
    std::vector<uint32_t> codes;     // see core/octahedral.h
    Storage storage = Storage::none;

    // Value of the normal of a vertex whose triangles are flat.
    static constexpr Vec3 of_flat()
    {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        return {nan, nan, nan};
    }

    bool empty() const { return storage == Storage::none; }
    bool are_of_vertices() const { return static_cast<uint8_t>(storage) & 1; }
    // Normal indices of a triangle, if it has any. The object must not be empty().
    const Corners& named_by(const Mesh& mesh, uint32_t triangle) const
    {
        return are_of_vertices() ? mesh.triangles[triangle] : triangles[triangle];
    }
    // The normal with an index from named_by().
    Vec3 value(const Mesh& mesh, uint32_t named) const
    {
        if (storage == Storage::vertices) return mesh.positions[named + 1];
        return storage == Storage::corners ? values[named] : decoded(named);
    }
    // The same, followed by another number.
    Float4 row(const Mesh& mesh, uint32_t named) const
    {
        if (storage == Storage::vertices) return load4(&mesh.positions[named + 1].x);
        if (storage == Storage::corners) return load4(&values[named].x);
        const Vec3 n = decoded(named);
        return Float4{n.x, n.y, n.z, 0};
    }
    // The normals of a triangle's corners; null if it is flat.
    const Corners* find(const Mesh& mesh, uint32_t triangle) const
    {
        if (empty()) return nullptr;
        const Corners& c = named_by(mesh, triangle);
        const bool flat = are_of_vertices() ? std::isnan(value(mesh, c[0]).x) : c[0] == none;
        return flat ? nullptr : &c;
    }
    uint64_t bytes() const
    {
        return values.size() * sizeof(Vec3) + triangles.size() * sizeof(Corners) + codes.size() * sizeof(uint32_t);
    }

private:
    // Of a code. Not inline, so that it takes no registers from those who read floats.
    Vec3 decoded(uint32_t named) const;
};

}  // namespace lancer
