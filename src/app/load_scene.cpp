#include "app/load_scene.h"

#include <algorithm>
#include <filesystem>

#include "app/asset_files.h"
#include "app/console.h"
#include "app/paths.h"
#include "core/hash.h"
#include "core/names.h"
#include "io/asset_path.h"
#include "io/input_file.h"
#include "io/obj/obj.h"
#include "io/scene/scene_file.h"
#include "scene/camera.h"

namespace lancer {
namespace {

bool is_mesh(const std::string& path) { return extension_of(path) == ".obj"; }

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

// Emissive materials count only if a face uses them.
bool emits(const MeshData& mesh)
{
    const auto shines = [&](size_t material) {
        return material < mesh.materials.size() && !is_black(mesh.materials[material].emission);
    };
    if (mesh.face_material.empty()) return shines(0);
    return std::any_of(mesh.face_material.begin(), mesh.face_material.end(), shines);
}

// Whether a light is there or may be: materials given by name are there for a reason.
bool emits(const SceneDescription& scene)
{
    const auto shines = [](const MaterialDescription& m) { return !is_black(m.emission); };
    return !scene.lights.empty() || scene.background ||
           std::any_of(scene.materials.begin(), scene.materials.end(), shines) ||
           std::any_of(scene.meshes.begin(), scene.meshes.end(),
                       [](const MeshDescription& m) { return m.material.empty() && emits(*m.data); });
}

std::string smoothing_text(const Smoothing& s)
{
    return " --smooth " + (s.faces == Smoothing::Faces::none ? "off" : shortest(s.largest_deg));
}

template <class Number>
std::string to_toml(Number x, Number y, Number z)
{
    return "[" + shortest(x) + ", " + shortest(y) + ", " + shortest(z) + "]";
}
std::string to_toml(Vec3d v) { return to_toml(v.x, v.y, v.z); }
std::string to_toml(Color c) { return to_toml(c.r, c.g, c.b); }

std::string to_toml_string(const std::string& text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + "\"";
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
    for (const std::string& definition : choice.definitions) text += " -D " + in_shell_quotes(definition);
    return text;
}

std::string complete_scene(SceneDescription& scene, double aspect)
{
    std::string added;
    const bool is_bare = is_mesh(scene.file);
    if (is_bare) {
        const std::string name = std::filesystem::path(scene.file).filename();
        added += "version = 1\n[[mesh]]\nfile = " + to_toml_string(name) + "\n";
    }
    if (!scene.camera) {
        scene.camera = fit_camera(subject_bounds(scene), aspect);
        added += "[camera]\nposition = " + to_toml(scene.camera->position) +
                 "\ntarget = " + to_toml(scene.camera->target) + "\nfov = " + shortest(scene.camera->fov_deg) + "\n";
    }
    if (is_bare && !emits(scene))
        for (LightDescription& light : default_lights(subject_bounds(scene))) {
            light.where = {scene.file, 0, 0};
            const bool sun = light.type == LightType::sphere;
            added += std::string("[[light]]\ntype = \"") + (sun ? "sphere" : "environment") + "\"\n";
            if (sun) added += "center = " + to_toml(light.position) + "\nradius = " + shortest(light.radius) + "\n";
            added += "radiance = " + to_toml(light.power) + "\n";
            scene.lights.push_back(std::move(light));
        }
    return added;
}

}  // namespace lancer
