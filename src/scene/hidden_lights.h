// Point and directional lights that no technique finds. Light sampling is the only one that finds them, and mirrors and
// smooth glass stop its shadow rays: a bulb within a glass body, or a sun behind a pane, lights nothing.
#pragma once

#include <cstdint>

#include "core/error.h"
#include "geometry/accel.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace lancer {

// Follows a fixed set of paths from the camera and sends shadow rays to each such light. Warns of a light if mirrors
// and smooth glass stop nearly all of those that nothing else does, or if nothing but these is met; returns how many
// there are. A scene without such lights or such surfaces costs nothing; a light that is found soon costs a few rays.
// For the integrators path and direct. The accelerator must have been built from the scene's geometry.
uint32_t warn_of_hidden_lights(const SceneDescription& description, const Scene& scene, const Accelerator& accel,
                               const Camera& camera, PictureSize size, Diagnostics& problems);

}  // namespace lancer
