#include "io/scene/shutter.h"

#include <algorithm>
#include <filesystem>

#include "core/hash.h"
#include "io/scene/frame_tree.h"
#include "io/scene/scene_tables.h"
#include "scene/placement.h"

namespace lancer {
namespace {

// Adds the places that a description has at some time to the paths of what moves; of spheres, which may be parts of
// bubbles, to all.
void add_places(const SceneDescription& then, const Animation& animation, SceneDescription& scene)
{
    for (const size_t i : animation.moved_of("mesh")) scene.meshes[i].path.push_back(then.meshes[i].transform);
    for (const size_t i : animation.moved_of("instance"))
        scene.instances[i].path.push_back(then.instances[i].transform);
    for (size_t i = 0; i < scene.spheres.size(); ++i)
        scene.spheres[i].path.push_back({then.spheres[i].center, then.spheres[i].radius});
}

// A name for a mesh that has none, or that of an earlier one.
std::string new_name(const SceneDescription& scene, const MeshDescription& mesh)
{
    const auto is_taken = [&](const std::string& name) {
        return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const auto& m) { return m.name == name; });
    };
    std::string first = mesh.name;
    if (first.empty() && mesh.data && !mesh.data->file.empty())
        first = std::filesystem::path(mesh.data->file).stem().string();
    if (first.empty()) first = "mesh";
    std::string name = first;
    for (size_t i = 2; is_taken(name); ++i) name = first + "." + std::to_string(i);
    return name;
}

}  // namespace

void read_paths(const TomlValue& root, const Animation& animation, double frame, const AssetFolder& assets,
                const std::vector<std::string>& definitions, SceneDescription& scene, Diagnostics& diagnostics)
{
    const AnimationDescription& d = animation.description();
    if (!(d.shutter > 0)) return;
    if (!d.blurs_all)
        diagnostics.warning({scene.file},
                            "[animation] shutter: the motion of cameras, meshes, instances, spheres and bubbles blurs "
                            "the picture; what else moves stays as it is when the shutter opens");
    if (!animation.moves_views() && !animation.moves_things()) return;
    constexpr int steps = 16;
    for (int i = 0; i <= steps; ++i) {
        TomlValue tree = root;
        SceneDescription then;
        then.file = scene.file;
        TomlProblems problems = problems_of(scene.file, definitions);
        const std::vector<FrameValue> values = animation.values_at(frame + d.shutter * i / steps, frame);
        put_frame(tree, values, definitions, problems);
        read_scene_tables(TomlTable(tree, "", problems), assets, then);
        problems.report(diagnostics, ", while the shutter of a frame is open");
        if (diagnostics.has_errors()) return;
        for (const FrameValue& own : values)
            if (!own.moves_view) scene.still_hash = hash_bytes(text_of(own), scene.still_hash);
        if (animation.moves_views()) scene.cameras_later.push_back({then.camera, then.cameras});
        if (animation.moves_things()) add_places(then, animation, scene);
    }
}

void add_instances_of_moving(SceneDescription& scene)
{
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        if (scene.meshes[i].path.empty() || Placement(scene).instanced[i]) continue;
        MeshDescription& mesh = scene.meshes[i];
        const auto first = std::find_if(scene.meshes.begin(), scene.meshes.end(),
                                        [&](const MeshDescription& m) { return m.name == mesh.name; });
        if (mesh.name.empty() || &*first != &mesh) mesh.name = new_name(scene, mesh);
        scene.instances.push_back({mesh.where, mesh.name, {}});
    }
}

}  // namespace lancer
