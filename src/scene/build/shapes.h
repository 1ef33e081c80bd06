// Shapes of scene files that are built from others: planes with bands and with waves, bubbles, triangles, pyramids.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/error.h"
#include "scene/description/description.h"
#include "scene/surface.h"

namespace lancer {

class MaterialTable;

// The directions of u and v on a plane that says nothing of them, unit: on floors u is along x and v away along -z, on
// walls v is up. n: unit.
std::array<Vec3d, 2> default_axes(Vec3d n);

PlaneMap make_plane_map(const PlaneDescription& plane);

// Default waves of water. legacy: for slopes without the factor of 2 pi.
std::vector<Wave> default_waves(bool legacy);

// The material with inside and outside exchanged; nothing if it has no inside.
std::optional<MaterialDescription> inside_out(MaterialDescription material);

// One triangle. uv: in a picture the corner a is the upper left one, b the upper right one, c the lower left one; as
// Rim wants it.
std::shared_ptr<const MeshData> make_triangle(Vec3d a, Vec3d b, Vec3d c);

// Four triangles over a square that is open below: its middle at `center`, its sides of length `side`, the apex above
// by side / sqrt(2). Normals point outwards. up: not zero. Each triangle has uv like make_triangle, its corner c the
// apex.
std::shared_ptr<const MeshData> make_pyramid(Vec3d center, double side, Vec3d up);

// The id of the material of a sphere. Reports an error if it cannot be turned inside out.
uint32_t material_of(const SphereDescription& sphere, MaterialTable& materials, Diagnostics& diagnostics);
uint32_t material_of(const PlaneDescription& plane, bool legacy, MaterialTable& materials);

}  // namespace lancer
