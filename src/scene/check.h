// What `lancer check` finds in a scene beyond the problems that building it reports: things that are allowed, and
// most likely not meant.
#pragma once

#include "core/error.h"
#include "geometry/accel.h"
#include "scene/scene.h"

namespace lancer {

// Meshes whose vertex normals contradict the winding of their faces; as notes: flat meshes, triangles that are there
// twice, a camera that is not there.
void check_description(const SceneDescription& description, Diagnostics& problems, Diagnostics& notes);

// Meshes that wear textures without saying where.
void check_texture_coordinates(const SceneDescription& description, const Scene& scene, Diagnostics& problems);

// Emitters of one side that light nothing but a wall right in front of them, or the inside of their own shape. The
// accelerator must be built from the scene's geometry.
void check_emitters(const SceneDescription& description, const Scene& scene, const Accelerator& accel,
                    Diagnostics& problems);

}  // namespace lancer
