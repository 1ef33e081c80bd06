#include "app/defaults/complete_scene.h"

#include <filesystem>

#include "app/defaults/default_light.h"
#include "app/defaults/default_view.h"
#include "app/defaults/toml_text.h"
#include "app/paths.h"

namespace lancer {

std::string complete_scene(SceneDescription& scene, const SceneChoice& choice, double aspect)
{
    std::string added;
    const bool is_bare = is_mesh(choice.file);
    if (is_bare) {
        const std::string name = std::filesystem::path(choice.file).filename();
        added += "version = 1\n[[mesh]]\nfile = " + to_toml_string(name) + "\n";
    }
    added += add_default_view(scene, aspect);
    if (is_bare) added += add_default_light(scene);
    return added;
}

}  // namespace lancer
