#include "io/scene/scene_file.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "core/hash.h"
#include "core/names.h"
#include "io/file_name.h"
#include "io/gltf/gltf.h"
#include "io/input_text.h"
#include "io/scene/animation.h"
#include "io/scene/definition.h"
#include "io/scene/frame_tree.h"
#include "io/scene/scene_tables.h"
#include "io/scene/shutter.h"
#include "io/shared_mesh.h"
#include "io/subdivide/catmull_clark.h"
#include "io/toml_file.h"
#include "scene/description/material.h"

namespace lancer {
namespace {

// Of the one mesh of a scene, which stays where its file places it.
void add_instances(const std::vector<SharedMesh>& shared, SceneDescription& scene)
{
    for (const SharedMesh& s : shared) {
        MeshDescription& whole = scene.meshes.front();
        if (s.data == whole.data) {
            whole.name = s.name;
        } else {
            MeshDescription own = whole;
            own.name = s.name, own.data = s.data;
            scene.meshes.push_back(std::move(own));
        }
        InstanceDescription all{scene.meshes.front().where, s.name, s.places.front()};
        all.more.assign(s.places.begin() + 1, s.places.end());
        scene.instances.push_back(std::move(all));
    }
}

// Whether the scene is nothing but a mesh, as its file has it.
bool is_bare(const SceneDescription& scene)
{
    if (scene.meshes.size() != 1) return false;
    const TransformDescription& t = scene.meshes[0].transform;
    return scene.instances.empty() && scene.meshes[0].name.empty() && t.translate == Vec3d{} &&
           t.rotate_deg == Vec3d{} && t.scale == Vec3d{1, 1, 1};
}

void load_meshes(const std::vector<MeshFile>& files, const SceneFileOptions& scene_options, const AssetFolder& assets,
                 SceneDescription& scene, Diagnostics& diagnostics)
{
    std::vector<SharedMesh> shared;
    // What an override gives to a material of a mesh is known only when it is applied.
    const bool uvs =
        !scene.overrides.empty() || std::any_of(scene.materials.begin(), scene.materials.end(), reads_textures);
    MeshOptions options{.assets = &assets, .pictures = {}, .uvs = uvs};
    if (is_gltf(scene.file) && is_bare(scene)) options.shared = &shared;
    // Materials of files that every mesh replaces by its own are not worn, and their pictures not read.
    std::set<std::string> worn;
    for (size_t i = 0; i < files.size(); ++i)
        if (scene.meshes[i].material.empty()) worn.insert(files[i].file.identity);
    std::map<std::tuple<std::string, Smoothing, uint32_t>, std::shared_ptr<const MeshData>> loaded;
    for (size_t i = 0; i < files.size(); ++i) {
        const AssetFolder::Found& file = files[i].file;
        if (file.path.empty()) continue;
        options.smoothing = files[i].smoothing.value_or(scene_options.smoothing.value_or(Smoothing{}));
        const auto [entry, is_new] = loaded.try_emplace({file.identity, options.smoothing, files[i].catmull_clark});
        options.pictures = worn.count(file.identity) ? scene_options.pictures : RasterSource{};
        if (is_new) entry->second = scene_options.mesh_loader(file.path, diagnostics, options);
        if (is_new && entry->second && files[i].catmull_clark > 0)
            entry->second =
                std::make_shared<const MeshData>(catmull_clark(*entry->second, files[i].catmull_clark, files[i].where));
        scene.meshes[i].data = entry->second;
        // No caller should meet a null that nobody has reported.
        if (!entry->second && !diagnostics.has_errors()) {
            diagnostics.error(files[i].where, "mesh file " + in_quotes(file.path) + " could not be loaded");
        }
    }
    add_instances(shared, scene);
}

// Of a scene file that holds nothing but a [[mesh]], and the cameras and lights of a glTF file.
TomlValue tree_of_mesh(const std::string& path, Diagnostics& diagnostics)
{
    TomlValue::Table root;
    if (is_gltf(path)) root = gltf_tables(path, diagnostics);
    const TomlValue::Table mesh{{.key = "file", .value = {.data = std::filesystem::path(path).filename().string()}}};
    root.push_back({.key = "mesh", .value = {.data = TomlValue::Array{{.data = mesh}}}});
    return {.data = std::move(root)};
}

// The frame that is asked for, else the first. Throws Error (usage) if there is none such.
double frame_of(const std::optional<Animation>& animation, std::optional<double> asked)
{
    if (!animation) {
        if (asked) throw Error(ErrorKind::usage, {}, "--frame: the scene has no [animation]");
        return 0;
    }
    const AnimationDescription& d = animation->description();
    if (asked && (*asked < d.first || *asked > d.last))
        throw Error(
            ErrorKind::usage, {},
            "--frame: the frames of the scene are " + std::to_string(d.first) + " to " + std::to_string(d.last));
    return asked.value_or(d.first);
}

void hash_frame(const std::vector<FrameValue>& values, double frame, SceneDescription& scene)
{
    scene.content_hash = hash_bytes("frame " + std::to_string(frame), scene.content_hash);
    for (const FrameValue& own : values)
        if (!own.moves_view) scene.still_hash = hash_bytes(text_of(own), scene.still_hash);
}

// Reads the tables of every frame, so that what is wrong in one is said before any is drawn.
void check_frames(const TomlValue& root, const Animation& animation, const AssetFolder& assets,
                  const SceneFileOptions& options, const std::string& path, Diagnostics& diagnostics)
{
    for (uint64_t frame = animation.description().first; frame <= animation.description().last; ++frame) {
        TomlValue tree = root;
        SceneDescription none;
        none.file = path;
        TomlProblems problems = problems_of(path, options.definitions);
        put_frame(tree, animation.values_at(static_cast<double>(frame)), options.definitions, problems);
        read_scene_tables(TomlTable(tree, "", problems), assets, none);
        problems.report(diagnostics, ", in frame " + std::to_string(frame));
        if (diagnostics.has_errors()) return;
    }
}

// Whether meshes may be divided for a camera.
bool may_divide(const SceneDescription& scene)
{
    return !scene.overrides.empty() || std::any_of(scene.meshes.begin(), scene.meshes.end(), [](const auto& m) {
        return m.subdivision.is_asked;
    }) || std::any_of(scene.materials.begin(), scene.materials.end(), [](const auto& m) { return m.displacement_map; });
}

// The [camera], or the first of those with names, if the file says where it stands.
std::optional<CameraDescription> camera_of_file(const SceneDescription& scene)
{
    const std::optional<CameraDescription> camera =
        scene.camera || scene.cameras.empty() ? scene.camera : std::optional(scene.cameras.front());
    return camera && !camera->missing.position ? camera : std::nullopt;
}

// Fills the description from the tree of values, with the definitions put over it.
void read_tree(TomlValue root, const AssetFolder& assets, const SceneFileOptions& options, SceneDescription& scene,
               Diagnostics& diagnostics)
{
    TomlProblems problems = problems_of(scene.file, options.definitions);
    define_all(root, options.definitions, problems);
    for (const std::string& text : options.definitions) scene.content_hash = hash_bytes(text, scene.content_hash);
    scene.still_hash = scene.content_hash;
    const std::optional<Animation> animation = Animation::read(root, problems);
    const double frame = frame_of(animation, options.frame);
    const TomlValue of_file = animation ? root : TomlValue{};
    if (animation && !problems.has_any()) {
        if (options.checks_frames) check_frames(root, *animation, assets, options, scene.file, diagnostics);
        if (diagnostics.has_errors()) return;
        const std::vector<FrameValue> values = animation->values_at(frame);
        put_frame(root, values, options.definitions, problems);
        hash_frame(values, frame, scene);
        scene.animation = animation->description();
        scene.animation->frame = frame;
    }
    const std::vector<MeshFile> files = read_scene_tables(TomlTable(root, "", problems), assets, scene);
    problems.report(diagnostics);
    if (animation && !options.still && !diagnostics.has_errors())
        read_paths(of_file, *animation, frame, assets, options.definitions, scene, diagnostics);
    if (may_divide(scene)) {
        scene.first_camera = camera_of_file(scene);
        if (animation && frame != animation->description().first && !diagnostics.has_errors()) {
            TomlValue first = of_file;
            SceneDescription then;
            TomlProblems ignored = problems_of(scene.file, options.definitions);
            put_frame(first, animation->values_at(animation->description().first), options.definitions, ignored);
            read_scene_tables(TomlTable(first, "", ignored), assets, then);
            scene.first_camera = camera_of_file(then);
        }
    }
    load_meshes(files, options, assets, scene, diagnostics);
    add_instances_of_moving(scene);
}

// As it stands, with the definitions put over it.
TomlValue defined_tree(const std::string& path, const std::vector<std::string>& definitions, Diagnostics& diagnostics,
                       TomlProblems& problems)
{
    TomlValue root{.data = TomlValue::Table{}};
    if (is_mesh(path)) {
        Diagnostics ignored;  // who loads the scene is told
        root = tree_of_mesh(path, ignored);
    } else if (std::optional<TomlValue> read = parse_toml(read_input_text(path), path, diagnostics)) {
        root = std::move(*read);
    }
    define_all(root, definitions, problems);
    return root;
}

}  // namespace

SceneDescription parse_scene(std::string_view text, const std::string& path, const SceneFileOptions& options,
                             Diagnostics& diagnostics)
{
    SceneDescription scene;
    scene.file = path;
    scene.content_hash = hash_bytes(text);
    const AssetFolder assets(path, options.asset_root);
    if (std::optional<TomlValue> root = parse_toml(text, path, diagnostics))
        read_tree(std::move(*root), assets, options, scene, diagnostics);
    return scene;
}

SceneDescription load_scene_file(const std::string& path, const SceneFileOptions& options, Diagnostics& diagnostics)
{
    return parse_scene(read_input_text(path), path, options, diagnostics);
}

SceneDescription wrap_mesh(const std::string& path, const SceneFileOptions& options, Diagnostics& diagnostics)
{
    SceneDescription scene;
    scene.file = path;
    AssetFolder assets(path, options.asset_root);
    assets.admit(std::filesystem::path(path).filename().string());
    read_tree(tree_of_mesh(path, diagnostics), assets, options, scene, diagnostics);
    return scene;
}

std::optional<AnimationDescription> read_animation(const std::string& path, const std::vector<std::string>& definitions,
                                                   Diagnostics& diagnostics)
{
    TomlProblems problems = problems_of(path, definitions);
    const TomlValue root = defined_tree(path, definitions, diagnostics, problems);
    const std::optional<Animation> animation = Animation::read(root, problems);
    problems.report(diagnostics);
    if (!animation) return {};
    return animation->description();
}

TomlValue scene_tree(const std::string& path, const std::vector<std::string>& definitions, Diagnostics& diagnostics,
                     std::optional<double> frame)
{
    TomlProblems problems = problems_of(path, definitions);
    TomlValue root = defined_tree(path, definitions, diagnostics, problems);
    if (const std::optional<Animation> animation = Animation::read(root, problems)) {
        put_frame(root, animation->values_at(frame_of(animation, frame)), definitions, problems);
        auto& tables = std::get<TomlValue::Table>(root.data);
        std::erase_if(tables, [](const TomlEntry& e) { return e.key == "animation"; });
    }
    problems.report(diagnostics);
    return root;
}

OutputDescription read_output(const std::string& path, const std::vector<std::string>& definitions,
                              Diagnostics& diagnostics, std::optional<double> frame)
{
    const TomlValue root = scene_tree(path, definitions, diagnostics, frame);
    TomlProblems problems = problems_of(path, definitions);
    const std::optional<TomlTable> table = TomlTable(root, "", problems).table("output");
    const OutputDescription output = table ? read_output_table(*table) : OutputDescription{};
    problems.report(diagnostics);
    return output;
}

}  // namespace lancer
