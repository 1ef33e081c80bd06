// What the window shows.
#pragma once

#include <memory>

#include "app/view/shown.h"
#include "scene/description/description.h"
#include "scene/description/render_settings.h"

namespace lancer {

// All that decides the picture.
struct Sight {
    CameraDescription camera;
    std::shared_ptr<const SceneDescription> scene;  // what has changed is another object
    RenderSettings settings;                        // resolved; spp: the samples that a picture ends with
    ShownAs shown = ShownAs::light;
    uint64_t rest = 0;  // equal for scenes that differ in point and directional lights alone
};

}  // namespace lancer
