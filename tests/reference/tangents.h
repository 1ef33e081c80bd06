// Tangents of MikkTSpace for maps of normals, by walking around each corner. Mikkelsen, "Simulation of Wrinkled
// Surfaces Revisited", master's thesis, 2008.
#pragma once

#include <optional>

#include "reference/placing.h"

namespace reference {

// Of the corners of a triangle, unit, in the space of the file; of both, cross(normal, along) * sign is towards +v.
struct Tangents3 {
    Vec along[3];
    double sign = 1;
};
// Those of the file, or computed; nothing where the triangle has no area in the picture. data: with texture
// coordinates.
std::optional<Tangents3> tangents_of(const lancer::MeshData& data, uint32_t triangle);

}  // namespace reference
