// The view of a scene without camera. complete_scene() calls it.
#pragma once

#include <string>

#include "scene/description/description.h"

namespace lancer {

struct DefaultView {
    std::string added;  // as the text of a scene file; empty if there is a camera
    Vec3d up{0, 1, 0};  // of the scene, unit
};

// Gives a scene without camera one that sees all of it. aspect: width over height.
DefaultView add_default_view(SceneDescription& scene, double aspect);

}  // namespace lancer
