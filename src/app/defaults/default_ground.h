// The ground below a bare mesh, which catches its shadow. default_light.cpp calls it, as the ground's colour is that of
// the sky.
#pragma once

#include "app/defaults/default_view.h"
#include "scene/description/description.h"

namespace lancer {

// Whether a ground below the scene would show and suits it: not from below or from inside, nor for sheets and rooms
// that are open on one side, nor where the mesh has a floor of its own. A floor is what lies at the foot of nearly all
// of the mesh, seen from above, and is not covered by it in at least a third of its area; so no block is taken for one.
// The scene must have the camera that `view` tells of.
bool wants_ground(const SceneDescription& scene, const DefaultView& view);

// Adds a plane of this albedo that touches the mesh from below, and its material, which gets a name that the scene does
// not have. up: unit.
void add_ground(SceneDescription& scene, Vec3d up, Color albedo);

}  // namespace lancer
