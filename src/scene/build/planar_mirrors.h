// Finds the large flat mirrors of a scene.
#pragma once

#include "scene/scene.h"

namespace lancer {

// Fills Scene::mirrors, MeshShading::mirror_of and Scene::instance_mirror_of: at most four planes with triangles of one
// smooth mirror or metal of a mesh or an instance, the largest first; of an instance only the four that are the largest
// in its mesh. Each has at least 1/256 of the area of the scene's bounds, and 1/16 of the largest mirror's. Textures,
// bounds and the table of lights must be there. Finds none where no light is finite or a direction.
void find_planar_mirrors(Scene& scene);

}  // namespace lancer
