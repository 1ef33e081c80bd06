// Other point and directional lights in a complete scene.
#pragma once

#include <memory>

#include "scene/scene.h"

namespace lancer {

// Lists the point and directional lights that a description says, type by type.
void list_delta_lights(const SceneDescription& description, Scene& scene, Diagnostics& diagnostics);

// Lists all lights, and what depends on them: mirrors that show them, and whether they pass glass.
void list_lights(Scene& scene);

// The scene with the point and directional lights of a description, which in all else is that of the scene. Shapes and
// opacity stay: accelerators of the scene serve both as long as it lives. Must be called inside with_threads.
std::unique_ptr<const Scene> relit(const Scene& scene, const SceneDescription& description, Diagnostics& diagnostics);

}  // namespace lancer
