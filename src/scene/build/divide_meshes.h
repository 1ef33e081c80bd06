// Divides and displaces the meshes of a scene before it is built.
#pragma once

#include <optional>

#include "scene/build/picture_memory.h"
#include "scene/scene.h"

namespace lancer {

// The description with its divided meshes; nothing where no mesh is to be divided. Meshes are divided if they say so,
// or if they wear a material of the scene file, or one that it changes, that has a displacement map. A displacement map
// of a mesh file alone does not divide: programs write such maps for other uses, too. memory.limit: what dividing may
// take; throws Error (no_memory) before it is taken. notes: what was done, for reports.
std::optional<SceneDescription> divide_meshes(const SceneDescription& description, const RenderSettings& settings,
                                              const RasterSource& images, const PictureMemory& memory,
                                              std::vector<Scene::Note>& notes, Diagnostics& diagnostics);

}  // namespace lancer
