#include "app/load_scene.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "app/console.h"
#include "app/paths.h"
#include "core/names.h"
#include "io/asset_path.h"
#include "io/input_file.h"
#include "io/obj.h"
#include "io/scene_file.h"
#include "scene/camera.h"

namespace lancer {
namespace {

bool is_mesh(const std::string& path) { return extension_of(path) == ".obj"; }

SceneDescription load_bare_mesh(const std::string& path, const std::string& asset_root, Diagnostics& diagnostics)
{
    const AssetFolder assets(path, asset_root);
    SceneDescription scene;
    scene.file = path;
    scene.render.where = {path};
    MeshDescription mesh;
    mesh.where = {path};
    mesh.data = load_obj(path, diagnostics, {.assets = &assets});
    scene.meshes.push_back(mesh);
    return scene;
}

// Not the names but what is in the files decides; the same file twice counts once.
void hash_meshes(SceneDescription& scene)
{
    std::set<const MeshData*> seen;
    for (const MeshDescription& mesh : scene.meshes)
        if (mesh.data && seen.insert(mesh.data.get()).second)
            scene.content_hash = scene.content_hash * 0x9e3779b97f4a7c15u + mesh.data->content_hash;
}

// Materials that no face has shine for nobody.
bool emits(const MeshData& mesh)
{
    const auto shines = [&](size_t material) {
        return material < mesh.materials.size() && !is_black(mesh.materials[material].emission);
    };
    if (mesh.face_material.empty()) return shines(0);
    return std::any_of(mesh.face_material.begin(), mesh.face_material.end(), shines);
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

SceneDescription load_scene(const std::string& path, const std::string& asset_root, Diagnostics& diagnostics)
{
    SceneDescription scene;
    if (is_mesh(path)) {
        scene = load_bare_mesh(path, asset_root, diagnostics);
    } else if (extension_of(path) == ".toml") {
        scene = load_scene_file(path, {.asset_root = asset_root, .mesh_loader = load_obj}, diagnostics);
    } else {
        const InputFile exists(path);
        throw exists.invalid("not a scene: its name must end in .toml or .obj");
    }
    diagnostics.throw_if_errors();
    hash_meshes(scene);
    return scene;
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
    if (is_bare && !emits(*scene.meshes[0].data))
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
