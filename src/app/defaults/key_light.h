// Where the key light of a bare mesh comes from. default_light.cpp calls it.
#pragma once

#include "scene/description/description.h"

namespace lancer {

// The unit direction to it: over the left shoulder of who looks, whatever the view. The camera must not look along its
// `up`.
Vec3d way_to_key(const CameraDescription& camera);

// Whether the camera is within the bounds of the scene.
bool is_inside(const SceneDescription& scene);

}  // namespace lancer
