// The view of a scene that says nothing, or not all, of its camera. complete_scene() calls it.
#pragma once

#include <string>

#include "app/load_scene.h"

namespace lancer {

// Completes the camera of the scene, or gives it one, as scene/view/auto_view.h chooses it, and as --up and --view of
// the choice want it. aspect: width over height. The camera of the scene is complete then. Returns what was added as
// the text of a scene file, with what it is for in comments; empty if the scene says all.
struct DefaultView {
    std::string added;
    Vec3d up{0, 1, 0};                       // of the scene, unit
    SubjectKind kind = SubjectKind::object;  // of a bare mesh
};
DefaultView add_default_view(SceneDescription& scene, const SceneChoice& choice, double aspect);

}  // namespace lancer
