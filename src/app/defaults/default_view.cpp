#include "app/defaults/default_view.h"

#include "app/console.h"
#include "app/defaults/toml_text.h"
#include "scene/camera.h"
#include "scene/placement.h"

namespace lancer {

DefaultView add_default_view(SceneDescription& scene, double aspect)
{
    if (scene.camera) return {};
    scene.camera = fit_camera(subject_bounds(scene), aspect);
    return {"[camera]\nposition = " + to_toml(scene.camera->position) + "\ntarget = " + to_toml(scene.camera->target) +
            "\nfov = " + shortest(scene.camera->fov_deg) + "\n"};
}

}  // namespace lancer
