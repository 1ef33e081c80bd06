// Tangents of meshes for maps of normals, as programs that bake such maps compute them: those of MikkTSpace. Mikkelsen,
// "Simulation of Wrinkled Surfaces Revisited", master's thesis, University of Copenhagen, 2008. A map that was baked
// against one choice of tangents shows the right normals with the same choice alone.
#pragma once

#include "scene/scene.h"

namespace lancer {

// Gives tangents to the triangles whose material reads them, that have texture coordinates, and whose file gave none.
// Corners share a tangent if they have the same position, normal and texture coordinates, lie in triangles that are
// connected by edges, and these have the same orientation in the picture. It is the sum of the directions of +u of
// these triangles, each in the plane of the normal and weighted by the angle of the corner. Other triangles of the mesh
// count as well if they have texture coordinates. The result depends on the order of the triangles alone.
void add_mikk_tangents(Scene& scene);

}  // namespace lancer
