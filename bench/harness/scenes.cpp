#include "harness/scenes.h"

#include <cmath>

#include "harness/meshes.h"
#include "harness/stage.h"

namespace lancer::bench {
namespace {

BenchScene own_scene(const std::string& name, double aspect)
{
    return {name, aspect, {}, [name] { return load_description(scene_file(name)); }};
}

RenderSettings anchor_options(uint32_t max_depth)
{
    RenderSettings o;
    o.give(&RenderSettings::max_depth, max_depth);
    o.give(&RenderSettings::filter, FilterKind::box);
    return o;
}

SceneDescription load_anchor_cornell(const std::string& file)
{
    SceneDescription d = load_description(file);
    d.camera = camera_at({2.78, 2.73, -8}, {2.78, 2.73, 0}, 39.3077);
    return d;
}

SceneDescription load_statues(const std::string& file)
{
    SceneDescription d = load_description(file);
    d.camera = camera_at({0, 2.6, 7}, {0, 0.85, 0}, 38);
    MaterialDescription grey;
    grey.name = "grey", grey.base_color = {0.7f, 0.7f, 0.7f};
    d.materials = {grey};
    d.meshes.at(0).material = "grey";
    LightDescription sky;
    sky.type = LightType::environment, sky.power = {0.4f, 0.4f, 0.4f};
    d.lights = {sky};
    return d;
}

SceneDescription load_room(const std::string& file, const SharedRoom& room)
{
    SceneDescription d = load_description(file);
    d.camera = room.camera;
    return d;
}
SceneDescription load_grey_room(const std::string& file, const SharedRoom& room)
{
    SceneDescription d = describe_mesh(*load_description(file).meshes.at(0).data, room.camera);
    d.lights.resize(1);  // the sky, without the sun
    return d;
}

}  // namespace

RenderSettings BenchScene::options(uint32_t height) const
{
    RenderSettings o = picture;
    o.give(&RenderSettings::size, {static_cast<uint32_t>(std::lround(aspect * height)), height});
    return o;
}

std::vector<BenchScene> choose_scenes(const Options& options)
{
    std::vector<BenchScene> all;
    const auto add = [&](BenchScene scene) {
        if (options.wants(scene.name)) all.push_back(std::move(scene));
    };
    add(own_scene("cornell", 1));
    add(own_scene("still_life", 16.0 / 9));
    add(own_scene("spheres", 16.0 / 9));
    const auto refs = [&](const std::string& name) {
        const std::string start = shared_scenes() + "/anchors/refs/" + name;
        return std::array{start + "_cycles_1024.exr", start + "_tungsten_1024.exr"};
    };
    if (options.wants("anchor-cornell"))
        if (const std::string file = shared_file("anchors/cornell.obj", options.cache); !file.empty())
            add({"anchor-cornell", 1, anchor_options(8), [file] { return load_anchor_cornell(file); }, refs("cornell"),
                 256});
    if (options.wants("statues"))
        if (const std::string file = shared_file("anchors/statues.obj", options.cache); !file.empty())
            add({"statues", 4.0 / 3, anchor_options(6), [file] { return load_statues(file); }, refs("statues"), 192});
    // Rooms as their files have them, and all grey under a constant sky. They take their time, so they have to be asked
    // for.
    for (const SharedRoom& room : shared_rooms()) {
        const std::string grey = room.name + "-grey";
        const bool some = options.full || !options.only.empty();
        if (!some || !(options.wants(room.name) || options.wants(grey))) continue;
        const std::string file = shared_scene(room.file, options.cache);
        if (file.empty()) continue;
        add({room.name, 4.0 / 3, anchor_options(8), [=] { return load_room(file, room); }});
        add({grey, 4.0 / 3, anchor_options(8), [=] { return load_grey_room(file, room); }});
    }
    return all;
}

}  // namespace lancer::bench
