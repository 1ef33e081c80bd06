// Moves the vertices of a divided mesh by maps of heights, and gives it the normals of its new shape.
#pragma once

#include <span>

#include "materials/textures/texture.h"
#include "scene/description/description.h"

namespace lancer {

// Of a material: a point moves along its normal by (height - midlevel) * scale, in units of the mesh.
struct Displacement {
    const ImageTexture* heights = nullptr;  // null: it stays where it is
    float scale = 1, midlevel = 0;
};

// mesh: of divide(), all of whose triangles have normals. of_materials: of each of its materials, or one for all.
// Corners in the same place move by the same way, the mean of what each would move by, weighted by their angles: the
// surface stays closed across seams of texture coordinates and hard edges. Where corners in one place had one normal
// they have one again, the mean of the normals of their triangles, weighted likewise; hard edges stay hard.
void displace(MeshData& mesh, std::span<const Displacement> of_materials);

}  // namespace lancer
