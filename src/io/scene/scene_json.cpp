#include "io/scene/scene_json.h"

#include <nlohmann/json.hpp>

#include "core/names.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(Vec3d v) { return {v.x, v.y, v.z}; }
Json json_of(Color c) { return {c.r, c.g, c.b}; }
Json json_of(float x) { return x; }
Json json_of(double x) { return x; }
// Of what has a texture only the factor.
Json json_of(const ColorParam& p) { return json_of(p.value); }
Json json_of(const FloatParam& p) { return json_of(p.value); }
// Rows of 3x4 numbers, for columns (x, y, z, 1).
Json json_of(const Transform& t)
{
    return {{t.x.x, t.y.x, t.z.x, t.translation.x},
            {t.x.y, t.y.y, t.z.y, t.translation.y},
            {t.x.z, t.y.z, t.z.z, t.translation.z}};
}

// Whether other renderers have a material that is exactly this one.
bool is_exported(MaterialType type)
{
    return type == MaterialType::lambert || type == MaterialType::mirror || type == MaterialType::glass;
}

// What of a material cannot be said; empty: nothing.
std::string obstacle(const Scene& scene, uint32_t id)
{
    const auto is_even = [](const auto& param) { return param.texture == no_texture; };
    const Material& m = scene.materials[id];
    const MaterialTraits& traits = scene.traits[id];
    if (!scene.mix_of.empty() && scene.mix_of[id] != Scene::none) return "is a mix";
    if (traits.has_holes()) return "lets rays through";
    if (traits.tilts()) return "has bumps";
    if (!is_even(scene.emission[id].radiance)) return "has a texture of emission";
    const MaterialType type = std::visit([](const auto& x) { return x.type; }, m);
    if (!is_exported(type)) return "is of type " + std::string(name_of(type));
    bool all_even = true;
    std::visit(
        [&](const auto& x) { for_each_textured_parameter(x, [&](auto& p) { all_even = all_even && is_even(p); }); }, m);
    if (!all_even) return "has a texture";
    const auto* glass = std::get_if<Glass>(&m);
    if (glass && glass->thin) return "is thin glass";
    return glass && glass->roughness.value > 0 ? "is rough glass" : "";
}

Json json_of_material(const Scene& scene, uint32_t id)
{
    const Material& m = scene.materials[id];
    Json json{{"name", scene.material_names[id]}};
    std::visit(
        [&](const auto& x) {
            json["type"] = name_of(x.type);
            for_each_parameter(x, [&](std::string_view key, const auto& p) { json[std::string(key)] = json_of(p); });
        },
        m);
    if (const Emission& e = scene.emission[id]; !e.is_dark()) {
        json["emission"] = json_of(e.radiance.value);
        json["emission_both_sides"] = e.both_sides;
    }
    return json;
}

Json json_of_camera(const CameraDescription& c)
{
    Json json{{"type", name_of(c.type)},
              {"position", json_of(c.position)},
              {"target", json_of(c.target)},
              {"up", json_of(c.up)},
              {"fov_deg", c.fov_deg}};
    switch (c.type) {
        case CameraType::pinhole:
            break;
        case CameraType::thin_lens:
            json["aperture"] = c.aperture;
            json["focus"] = c.focus.value_or(length(c.target - c.position));
            break;
    }
    return json;
}

Json json_of_lights(const SceneDescription& d, const Scene& scene)
{
    Json lights = Json::array();
    for (const LightDescription& l : d.lights) {
        if (is_black(l.power)) continue;
        if (l.type == LightType::environment) continue;
        Json json{{"type", name_of(l.type)}};
        for_each_parameter_of(l.type, [&](const auto& row) {
            auto value = l.*row.field;
            if constexpr (std::is_same_v<decltype(value), Vec3d>)
                if (row.range == ParameterRange::nonzero_vector) value = normalize(value / max_component(abs(value)));
            json[std::string(row.key)] = json_of(value);
        });
        lights.push_back(std::move(json));
    }
    // The sum of all that there are, and of a background of one colour.
    if (!is_black(scene.environment))
        lights.push_back({{"type", "environment"}, {"radiance", json_of(scene.environment)}});
    return lights;
}

Json json_of_meshes(const SceneDescription& d, const std::vector<std::string>& files)
{
    Json meshes = Json::array();
    const Placement placement(d);
    for (size_t i = 0; i < d.meshes.size(); ++i) {
        const Transform own = to_transform(d.meshes[i].transform);
        Json transforms = Json::array();
        if (!placement.instanced[i]) transforms.push_back(json_of(own));
        for (const InstanceDescription& instance : d.instances)
            if (placement.by_name.at(instance.mesh) == i)
                transforms.push_back(json_of(compose(to_transform(instance.transform), own)));
        meshes.push_back({{"file", files[i]}, {"transforms", transforms}});
    }
    return meshes;
}

}  // namespace

void check_exportable(const SceneDescription& d, const SceneBuilder& builder, const RenderSettings& settings,
                      Diagnostics& diagnostics)
{
    const auto refuse = [&](const Location& where, const std::string& what) {
        diagnostics.error(where, what + ", which an exported scene cannot say");
    };
    const Location file{d.file, 0, 0};
    const Scene& scene = builder.unfinished();
    for (uint32_t id = 0; id < scene.materials.size(); ++id)
        if (const std::string what = obstacle(scene, id); !what.empty())
            refuse(file, "material " + in_quotes(scene.material_names[id]) + " " + what);
    if (!scene.media.empty()) refuse(file, "a material absorbs or has a priority");
    for (size_t i = 0; i < d.meshes.size(); ++i)
        if (!scene.shading[i].colors.empty()) refuse(d.meshes[i].where, "a mesh has colours of its vertices");
    if (const auto& pending = builder.pending().environment)
        refuse(pending->what.where, "the environment is a picture");
    if (const auto& pending = builder.pending().background)
        refuse(pending->what.where, "the background is not one colour");
    if (scene.glow) refuse(d.background->where, "lights are seen as discs");
    for (const RenderOption& option : render_options())
        if (option.is_switch() && is_biased(settings, option))
            refuse(file, std::string(option.name) + " is " + (value_text(settings, option) == "true" ? "on" : "off"));
}

std::string scene_json(const SceneDescription& d, const Scene& scene, const RenderSettings& settings,
                       const std::vector<std::string>& mesh_files)
{
    Json materials = Json::array(), spheres = Json::array(), planes = Json::array();
    for (uint32_t id = 0; id < scene.materials.size(); ++id) materials.push_back(json_of_material(scene, id));
    for (size_t i = 0; i < d.spheres.size(); ++i)
        spheres.push_back({{"center", json_of(d.spheres[i].center)},
                           {"radius", d.spheres[i].radius},
                           {"material", scene.sphere_material[i]}});
    for (size_t i = 0; i < d.planes.size(); ++i)
        planes.push_back({{"point", json_of(d.planes[i].point)},
                          {"normal", json_of(normalize(d.planes[i].normal))},
                          {"material", scene.plane_material[i]}});
    const Json all{{"schema", "lancer.scene/1"},
                   {"source", d.file},
                   {"size", {settings.size.width, settings.size.height}},
                   {"max_depth", settings.max_depth},
                   {"integrator", std::string(name_of(settings.integrator))},
                   {"filter", std::string(name_of(settings.filter))},
                   {"camera", json_of_camera(*d.camera)},
                   {"lights", json_of_lights(d, scene)},
                   {"materials", materials},
                   {"meshes", json_of_meshes(d, mesh_files)},
                   {"spheres", spheres},
                   {"planes", planes}};
    // A file name need not be UTF-8; the text must be.
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lancer
