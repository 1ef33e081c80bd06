// Makes thin sheets of the glass of meshes that has no inside, and one face of several in the same place.
#pragma once

#include <span>

#include "scene/scene.h"

namespace lancer {

class MaterialTable;

// Called when the scene has all its shapes. places: of each mesh of the description, from its units to those of
// Mesh::positions. Lists what it did in scene.sheets and how long it took in scene.analyses; warns of bodies that are
// inside out; without glass or opacity it does nothing.
void make_thin_glass(const SceneDescription& description, std::span<const Transform> places, MaterialTable& materials,
                     Scene& scene, Diagnostics& diagnostics);

}  // namespace lancer
