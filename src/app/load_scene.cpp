#include "app/load_scene.h"

#include "app/asset_files.h"
#include "app/console.h"
#include "app/paths.h"
#include "core/hash.h"
#include "core/names.h"
#include "io/asset_path.h"
#include "io/input_file.h"
#include "io/obj/obj.h"
#include "io/scene/scene_file.h"

namespace lancer {
namespace {

void choose_camera(SceneDescription& scene, const std::string& name)
{
    if (name.empty()) return;
    std::vector<std::string> known;
    for (const CameraDescription& camera : scene.cameras) {
        if (camera.name == name) {
            scene.camera = camera;
            return;
        }
        known.push_back(camera.name);
    }
    throw Error(ErrorKind::usage, {},
                "--camera: unknown camera " + in_quotes(name) +
                    (known.empty() ? "; the scene has no [camera.NAME]" : suggestion(name, known)));
}

std::string smoothing_text(const Smoothing& s)
{
    return " --smooth " + (s.faces == Smoothing::Faces::none ? "off" : shortest(s.largest_deg));
}

// Before assets are hashed: the picture is one of them.
void add_environment(SceneDescription& scene, const SceneChoice& choice)
{
    if (choice.ground && choice.env.empty()) return;
    const char* const option = choice.env.empty() ? "--no-ground" : "--env";
    if (!is_mesh(choice.file))
        throw Error(ErrorKind::usage, {},
                    std::string(option) + ": is for bare meshes; a scene file says its environment and ground itself");
    if (choice.env.empty()) return;
    const InputFile exists(choice.env);
    LightDescription light;
    light.where = {choice.env}, light.type = LightType::environment, light.power = {1, 1, 1}, light.file = choice.env;
    scene.lights.push_back(std::move(light));
}

}  // namespace

SceneDescription load_scene(const SceneChoice& choice, Diagnostics& diagnostics, const RasterSource& pictures)
{
    const SceneFileOptions options{.asset_root = choice.asset_root,
                                   .mesh_loader = load_obj,
                                   .pictures = pictures,
                                   .smoothing = choice.smoothing,
                                   .definitions = choice.definitions};
    SceneDescription scene;
    if (is_mesh(choice.file)) {
        scene = wrap_mesh(choice.file, options, diagnostics);
    } else if (extension_of(choice.file) == ".toml") {
        scene = load_scene_file(choice.file, options, diagnostics);
    } else {
        const InputFile exists(choice.file);
        throw exists.invalid("not a scene: its name must end in .toml or .obj");
    }
    diagnostics.throw_if_errors();
    if (choice.smoothing) scene.content_hash = hash_bytes(smoothing_text(*choice.smoothing), scene.content_hash);
    add_environment(scene, choice);
    choose_camera(scene, choice.camera);
    hash_assets(scene);
    return scene;
}

std::string options_text(const SceneChoice& choice)
{
    std::string text;
    if (!choice.asset_root.empty()) text += " --asset-root " + in_shell_quotes(choice.asset_root);
    if (choice.smoothing) text += smoothing_text(*choice.smoothing);
    if (!choice.camera.empty()) text += " --camera " + in_shell_quotes(choice.camera);
    if (!choice.env.empty()) text += " --env " + in_shell_quotes(choice.env);
    if (!choice.ground) text += " --no-ground";
    text += view_options_text(choice);
    for (const std::string& definition : choice.definitions) text += " -D " + in_shell_quotes(definition);
    return text;
}

std::string view_options_text(const SceneChoice& choice)
{
    std::string text;
    if (choice.up) text += " --up " + std::string(name_of(*choice.up));
    if (choice.view)
        text += " --view " + shortest(choice.view->azimuth_deg) + "," + shortest(choice.view->elevation_deg);
    return text;
}

}  // namespace lancer
