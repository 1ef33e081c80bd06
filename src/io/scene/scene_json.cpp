#include "io/scene/scene_json.h"

#include <nlohmann/json.hpp>

#include "core/names.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(Vec3d v) { return {v.x, v.y, v.z}; }
Json json_of(Color c) { return {c.r, c.g, c.b}; }
// Rows of 3x4 numbers, for columns (x, y, z, 1).
Json json_of(const Transform& t)
{
    return {{t.x.x, t.y.x, t.z.x, t.translation.x},
            {t.x.y, t.y.y, t.z.y, t.translation.y},
            {t.x.z, t.y.z, t.z.z, t.translation.z}};
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
    if (const auto* lambert = std::get_if<Lambert>(&m)) return is_even(lambert->albedo) ? "" : "has a texture";
    if (const auto* mirror = std::get_if<Mirror>(&m)) return is_even(mirror->tint) ? "" : "has a texture";
    const auto* glass = std::get_if<Glass>(&m);
    if (!glass) return std::visit([](const auto& x) { return std::string("is of type ") + x.name; }, m);
    if (!is_even(glass->tint) || !is_even(glass->roughness)) return "has a texture";
    return glass->roughness.value > 0 ? "is rough glass" : "";
}

Json json_of_material(const Scene& scene, uint32_t id)
{
    const Material& m = scene.materials[id];
    Json json{{"name", scene.material_names[id]}, {"type", std::visit([](const auto& x) { return x.name; }, m)}};
    if (const auto* lambert = std::get_if<Lambert>(&m)) json["base_color"] = json_of(lambert->albedo.value);
    if (const auto* mirror = std::get_if<Mirror>(&m)) json["base_color"] = json_of(mirror->tint.value);
    if (const auto* glass = std::get_if<Glass>(&m)) {
        json["base_color"] = json_of(glass->tint.value);
        json["ior"] = glass->ior;
    }
    if (const Emission& e = scene.emission[id]; !e.is_dark()) {
        json["emission"] = json_of(e.radiance.value);
        json["emission_both_sides"] = e.both_sides;
    }
    return json;
}

Json json_of_camera(const CameraDescription& c)
{
    Json json{{"type", c.type == CameraType::pinhole ? "pinhole" : "thin_lens"},
              {"position", json_of(c.position)},
              {"target", json_of(c.target)},
              {"up", json_of(c.up)},
              {"fov_deg", c.fov_deg}};
    if (c.type == CameraType::thin_lens) {
        json["aperture"] = c.aperture;
        json["focus"] = c.focus.value_or(length(c.target - c.position));
    }
    return json;
}

Json json_of_lights(const SceneDescription& d, const Scene& scene)
{
    Json lights = Json::array();
    for (const LightDescription& l : d.lights) {
        if (is_black(l.power)) continue;
        if (l.type == LightType::point)
            lights.push_back({{"type", "point"}, {"position", json_of(l.position)}, {"intensity", json_of(l.power)}});
        if (l.type == LightType::directional)
            lights.push_back({{"type", "directional"},
                              {"direction", json_of(normalize(l.direction / max_component(abs(l.direction))))},
                              {"irradiance", json_of(l.power)}});
        if (l.type == LightType::sphere)
            lights.push_back({{"type", "sphere"},
                              {"center", json_of(l.position)},
                              {"radius", l.radius},
                              {"radiance", json_of(l.power)}});
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

void check_exportable(const SceneDescription& d, const Scene& scene, const RenderSettings& settings,
                      Diagnostics& diagnostics)
{
    const auto refuse = [&](const Location& where, const std::string& what) {
        diagnostics.error(where, what + ", which an exported scene cannot say");
    };
    const Location file{d.file, 0, 0};
    for (uint32_t id = 0; id < scene.materials.size(); ++id)
        if (const std::string what = obstacle(scene, id); !what.empty())
            refuse(file, "material " + in_quotes(scene.material_names[id]) + " " + what);
    if (!scene.media.empty()) refuse(file, "a material absorbs or has a priority");
    for (size_t i = 0; i < d.meshes.size(); ++i)
        if (!scene.shading[i].colors.empty()) refuse(d.meshes[i].where, "a mesh has colours of its vertices");
    if (const auto& pending = scene.pending_environment) refuse(pending->what.where, "the environment is a picture");
    if (const auto& pending = scene.pending_background) refuse(pending->what.where, "the background is not one colour");
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
