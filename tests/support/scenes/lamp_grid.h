// Many lamps in rows.
#pragma once

#include "support/scenes/scenes.h"

namespace lancer {

// Squares in the plane of `corner`, as many to a row as there are rows, facing down; `step` from one to the next along
// x and z.
inline std::shared_ptr<const MeshData> make_lamp_grid(uint32_t row, Vec3d corner, double step, double size,
                                                      MaterialDescription material)
{
    std::vector<Vec3d> p;
    std::vector<std::array<uint32_t, 3>> t;
    for (uint32_t i = 0; i < row * row; ++i) {
        const double x = corner.x + step * (i % row), z = corner.z + step * (i / row);
        const auto at = static_cast<uint32_t>(p.size());
        for (const auto& [dx, dz] : {std::pair{0.0, 0.0}, {size, 0.0}, {size, size}, {0.0, size}})
            p.push_back({x + dx, corner.y, z + dz});
        t.insert(t.end(), {{at, at + 1, at + 2}, {at, at + 2, at + 3}});
    }
    return make_mesh_data(std::move(p), std::move(t), std::move(material));
}

}  // namespace lancer
