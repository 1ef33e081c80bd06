// Where the key light of a bare mesh comes from. default_light.cpp calls it.
#pragma once

#include "scene/description/description.h"

namespace lancer {

// The unit direction to it. Seen from outside, it is over the left shoulder of who looks, whatever the view. Inside a
// mesh that way is mostly barred: then it is the one of a ring of directions from which most of what is seen gets light
// through openings, if there is one. The scene must have a camera. up: of the world, unit. aspect: of the picture.
Vec3d way_to_key(const SceneDescription& scene, Vec3d up, double aspect);

// Whether the camera is within the bounds of the scene.
bool is_inside(const SceneDescription& scene);

}  // namespace lancer
