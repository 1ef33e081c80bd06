// Checks of `lancer check` beyond those of scene building: conditions that are allowed but probably unintended.
#pragma once

#include "core/error.h"
#include "geometry/accel.h"
#include "scene/scene.h"

namespace lancer {

// Meshes whose vertex normals contradict the winding of their faces. As notes: flat meshes, duplicate triangles, a
// missing camera.
void check_description(const SceneDescription& description, Diagnostics& problems, Diagnostics& notes);

// Meshes with textures but without texture coordinates.
void check_texture_coordinates(const SceneDescription& description, const Scene& scene, Diagnostics& problems);

// One-sided emitters that illuminate only a wall right in front of them or the inside of their own shape. The
// accelerator must have been built from the scene's geometry.
void check_emitters(const SceneDescription& description, const Scene& scene, const Accelerator& accel,
                    Diagnostics& problems);

}  // namespace lancer
