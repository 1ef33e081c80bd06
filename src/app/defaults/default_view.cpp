#include "app/defaults/default_view.h"

#include "app/console.h"
#include "app/defaults/toml_text.h"
#include "app/paths.h"

namespace lancer {
namespace {

std::string text_of(const AutoView& view)
{
    std::string text = "[camera]\n";
    for (const std::string& reason : view.reasons) text += "# " + reason + "\n";
    const CameraDescription& c = view.camera;
    text += "position = " + to_toml(c.position) + "\ntarget = " + to_toml(c.target) + "\n";
    if (c.up != Vec3d{0, 1, 0}) text += "up = " + to_toml(c.up) + "\n";
    return text + "fov = " + shortest(c.fov_deg) + "\n";
}

}  // namespace

DefaultView add_default_view(SceneDescription& scene, const SceneChoice& choice, double aspect)
{
    const bool is_bare = is_mesh(choice.file);
    const bool may_lie = is_bare && !is_gltf(choice.file);  // in a glTF file y is up
    CameraDescription camera;
    camera.where = {scene.file, 0, 0};
    camera.missing = {.position = true, .target = true, .up = true, .fov = true};
    if (scene.camera) camera = *scene.camera;
    if (choice.up) camera.missing.up = true;
    if (choice.view) camera.missing.position = camera.missing.target = true;
    const bool lacks_place = camera.missing.position || camera.missing.target;
    const AutoView view = choose_view(scene, camera,
                                      {.up = choice.up.value_or(may_lie ? UpChoice::automatic : UpChoice::y),
                                       .direction = choice.view,
                                       .wants_kind = is_bare},
                                      aspect);
    scene.camera = view.camera;
    const bool is_told = lacks_place || (camera.missing.up && view.camera.up != Vec3d{0, 1, 0});
    return {is_told ? text_of(view) : "", view.up, view.kind};
}

}  // namespace lancer
