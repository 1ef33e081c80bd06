#include "app/defaults/complete_scene.h"

#include <filesystem>

#include "app/defaults/default_light.h"
#include "app/defaults/default_view.h"
#include "app/paths.h"
#include "app/system_info.h"
#include "io/toml_write.h"

namespace lancer {

Completed complete_scene(SceneDescription& scene, const SceneChoice& choice, double aspect,
                         const RasterSource& pictures, const PictureMemory& memory)
{
    Completed completed;
    const bool is_bare = is_mesh(choice.file);
    // A glTF file says more than a [[mesh]] of its name would.
    const bool is_whole = is_gltf(choice.file) && (scene.camera || !scene.lights.empty());
    if (is_bare && !is_whole) {
        const std::string name = std::filesystem::path(choice.file).filename();
        completed.text += "version = 1\n[[mesh]]\nfile = " + to_toml_string(name) + "\n";
    }
    double begin = wall_seconds();
    const DefaultView view = add_default_view(scene, choice, aspect);
    if (is_bare || !view.added.empty()) completed.view_s = wall_seconds() - begin;
    completed.text += view.added;
    completed.up = view.up;
    if (!is_bare) return completed;
    begin = wall_seconds();
    const DefaultLight light = add_default_light(scene, choice, view, aspect, pictures, memory);
    completed.light_s = wall_seconds() - begin;
    completed.text += light.text;
    completed.light = light.note;
    return completed;
}

}  // namespace lancer
