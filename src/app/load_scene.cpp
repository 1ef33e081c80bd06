#include "app/load_scene.h"

#include "app/asset_files.h"
#include "app/console.h"
#include "app/frame_cache.h"
#include "app/paths.h"
#include "core/hash.h"
#include "core/names.h"
#include "io/asset_path.h"
#include "io/input_file.h"
#include "io/mesh_file.h"
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

void check_turntable(const SceneDescription& scene, const SceneChoice& choice)
{
    if (choice.turntable == 0) return;
    if (scene.animation) throw Error(ErrorKind::usage, {}, "--turntable: the scene has an [animation] of its own");
    if (choice.frame && *choice.frame >= choice.turntable)
        throw Error(ErrorKind::usage, {},
                    "--frame: the frames of --turntable " + std::to_string(choice.turntable) + " are 0 to " +
                        std::to_string(choice.turntable - 1));
}

}  // namespace

SceneDescription load_scene(const SceneChoice& choice, Diagnostics& diagnostics, const RasterSource& pictures,
                            FrameCache* film, bool checks_frames)
{
    const SceneFileOptions options{.asset_root = choice.asset_root,
                                   .mesh_loader = film ? film->once(load_mesh) : load_mesh,
                                   .pictures = pictures,
                                   .smoothing = choice.smoothing,
                                   .definitions = choice.definitions,
                                   .frame = choice.turntable ? std::nullopt : std::optional<double>(choice.frame),
                                   .still = choice.still,
                                   .checks_frames = checks_frames};
    SceneDescription scene;
    if (choice.text) {
        scene = parse_scene(*choice.text, choice.file, options, diagnostics);
    } else if (is_mesh(choice.file)) {
        scene = wrap_mesh(choice.file, options, diagnostics);
    } else if (extension_of(choice.file) == ".toml") {
        scene = load_scene_file(choice.file, options, diagnostics);
    } else {
        const InputFile exists(choice.file);
        throw exists.invalid("not a scene: its name must end in .toml, .obj, .ply, .gltf or .glb");
    }
    diagnostics.throw_if_errors();
    scene.meshes.insert(scene.meshes.end(), choice.meshes.begin(), choice.meshes.end());
    if (choice.smoothing) scene.content_hash = hash_bytes(smoothing_text(*choice.smoothing), scene.content_hash);
    add_environment(scene, choice);
    choose_camera(scene, choice.camera);
    check_turntable(scene, choice);
    hash_assets(scene, film ? &film->hashes : nullptr);
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
    if (choice.frame && !choice.turntable) text += " --frame " + std::to_string(*choice.frame);
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
    if (choice.turntable)
        text +=
            " --turntable " + std::to_string(choice.turntable) + " --frame " + std::to_string(choice.frame.value_or(0));
    return text;
}

}  // namespace lancer
