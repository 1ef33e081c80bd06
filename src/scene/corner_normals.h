// The shading normals at the corners of a mesh's triangles. In most scans and models each vertex has one: then the
// normals stand behind the positions of the mesh, and shading waits for two tables less.
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

    std::vector<Vec3> values;        // unit; one more than used, at the end: four numbers are read at a time
    std::vector<Corners> triangles;  // which of them each has, `none` where it is flat
    bool are_of_vertices = false;    // then both are empty, and Mesh::rows is two

    // Stands for the normal of a vertex whose triangles are flat.
    static constexpr Vec3 of_flat()
    {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        return {nan, nan, nan};
    }

    bool empty() const { return values.empty() && !are_of_vertices; }
    // Which of them a triangle names, if it names any. Only if not empty().
    const Corners& named_by(const Mesh& mesh, uint32_t triangle) const
    {
        return are_of_vertices ? mesh.triangles[triangle] : triangles[triangle];
    }
    // Of those that are named so.
    const Vec3& value(const Mesh& mesh, uint32_t named) const
    {
        return are_of_vertices ? mesh.positions[named + 1] : values[named];
    }
    // Which normals a triangle's corners have; null where it is flat.
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
