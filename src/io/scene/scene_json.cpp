#include "io/scene/scene_json.h"

#include <nlohmann/json.hpp>

#include "core/names.h"
#include "materials/material.h"
#include "scene/description/material.h"
#include "scene/description/render_options.h"
#include "scene/environment/environment.h"

namespace lancer {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(Vec3d v) { return {v.x, v.y, v.z}; }
Json json_of(Color c) { return {c.r, c.g, c.b}; }
Json json_of(float x) { return x; }
Json json_of(double x) { return x; }
// Rows of 3x4 numbers, for columns (x, y, z, 1).
Json json_of(const Transform& t)
{
    return {{t.x.x, t.y.x, t.z.x, t.translation.x},
            {t.x.y, t.y.y, t.z.y, t.translation.y},
            {t.x.z, t.y.z, t.z.z, t.translation.z}};
}

Json json_of(Vec2 v) { return {v.x, v.y}; }

bool is_mix(const Scene& scene, uint32_t id) { return !scene.mix_of.empty() && scene.mix_of[id] != Scene::none; }

// What of a material cannot be said; empty: nothing.
std::string obstacle(const Scene& scene, uint32_t id)
{
    const MaterialTraits& traits = scene.traits[id];
    if (!is_mix(scene, id) && std::holds_alternative<Interface>(scene.materials[id]))
        return "is of type " + std::string(name_of(MaterialType::interface));
    if (traits.bump == no_texture) return "";
    const auto* heights = std::get_if<ImageTexture>(&scene.textures[traits.bump]);
    if (!heights) return "has waves";
    if (heights->use().scale.x == 0 || heights->use().scale.y == 0) return "has bumps of a texture without extent";
    return traits.normal_map == no_texture ? "" : "has both bumps and a map of normals";
}

// The words of a texture that are the same for all types.
Json json_of_texture(std::string_view type, Vec2 scale, Vec2 offset)
{
    return {{"type", type}, {"scale", json_of(scale)}, {"offset", json_of(offset)}};
}
Json json_of_picture(const std::string& file, const ImageUse& use)
{
    Json json = json_of_texture("image", use.scale, use.offset);
    json["file"] = file;
    json["wrap"] = use.wrap == Wrap::repeat ? "repeat" : "clamp";
    return json;
}
Json json_of(const Texture& texture, uint32_t id)
{
    if (const auto* image = std::get_if<ImageTexture>(&texture))
        return json_of_picture(ExportedPictures::file_of_texture(id), image->use());
    if (const auto* checker = std::get_if<Checker>(&texture)) {
        Json json = json_of_texture("checker", checker->scale, checker->offset);
        json["even"] = json_of(checker->even), json["odd"] = json_of(checker->odd);
        return json;
    }
    if (const auto* grid = std::get_if<Grid>(&texture)) {
        Json json = json_of_texture("grid", grid->scale, grid->offset);
        json["band"] = json_of(grid->band), json["ground"] = json_of(grid->ground), json["width"] = grid->width;
        return json;
    }
    Json json = json_of_texture("rim", {1, 1}, {0, 0});
    if (const auto* rim = std::get_if<Rim>(&texture)) json["width"] = rim->width;
    return json;
}

// Writes parameters by their keys, and the places of their textures by the keys of these.
class MaterialWriter {
public:
    MaterialWriter(Json& json, const ExportedPictures& pictures) : json_(json), pictures_(pictures) {}

    template <class M>
    void write(const M& material)
    {
        for_each_parameter(material, [&](std::string_view key, const auto& p) {
            json_[std::string(key)] = value_of(p);
            if constexpr (is_textured<decltype(p)>) write_texture(map_key_of(key), p.texture);
        });
    }
    void write_texture(std::string_view key, uint32_t texture)
    {
        if (texture != no_texture) json_[std::string(key)] = pictures_.textures.at(texture);
    }

private:
    template <class P>
    static Json value_of(const P& p)
    {
        if constexpr (is_textured<P>)
            return json_of(p.value);
        else
            return json_of(p);
    }
    static std::string_view map_key_of(std::string_view key)
    {
        std::string_view found;
        for_each_material_parameter([&](const auto& row) {
            if (row.key == key) found = row.map_key;
        });
        return found;
    }

    Json& json_;
    const ExportedPictures& pictures_;
};

void add_special(Json& json, const Metal& metal)
{
    if (!metal.conductor) return;
    json["eta"] = json_of(metal.conductor->eta), json["k"] = json_of(metal.conductor->k);
}
void add_special(Json& json, const Glass& glass) { json["thin"] = glass.thin; }
void add_special(Json& json, const Principled& principled) { json["thin"] = principled.is_thin(); }
template <class M>
void add_special(Json&, const M&)
{
}

Json json_of_material(const Scene& scene, uint32_t id, const ExportedPictures& pictures)
{
    Json json{{"name", scene.material_names[id]}};
    MaterialWriter writer(json, pictures);
    if (is_mix(scene, id)) {
        const Mix& mix = scene.mixes[scene.mix_of[id]];
        json["type"] = name_of(MaterialType::mix);
        json["first"] = mix.first, json["second"] = mix.second;
        writer.write(mix);
    } else {
        std::visit(
            [&](const auto& x) {
                json["type"] = name_of(x.type);
                writer.write(x);
                add_special(json, x);
            },
            scene.materials[id]);
    }
    if (!pictures.coats[id].empty()) json["coat"] = pictures.coats[id];
    if (!pictures.sheets[id].empty()) json["sheet"] = pictures.sheets[id];
    if (const Emission& e = scene.emission[id]; !e.is_dark()) {
        json["emission"] = json_of(e.radiance.value);
        writer.write_texture("emission_texture", e.radiance.texture);
        json["emission_both_sides"] = e.both_sides;
    }
    const MaterialTraits& traits = scene.traits[id];
    if (traits.has_holes()) {
        json["opacity"] = traits.opacity.value;
        writer.write_texture("opacity_texture", traits.opacity.texture);
    }
    writer.write_texture("normal_texture", traits.normal_map);
    if (traits.catches_shadows) json["shadow_catcher"] = true;
    if (!pictures.bumps[id].empty())
        json["bumps"] = json_of_picture(pictures.bumps[id], std::get<ImageTexture>(scene.textures[traits.bump]).use());
    return json;
}

Json json_of_textures(const Scene& scene, const ExportedPictures& pictures)
{
    std::vector<Json> all(pictures.textures.size());
    for (const auto& [id, place] : pictures.textures) all[place] = json_of(scene.textures[id], id);
    return all;
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

Json json_of_lights(const SceneDescription& d, const Scene& scene, const ExportedPictures& pictures)
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
    if (scene.environment_map) {
        const Transform& t = scene.environment_map->to_world();
        const Json rows{{t.x.x, t.y.x, t.z.x}, {t.x.y, t.y.y, t.z.y}, {t.x.z, t.y.z, t.z.z}};
        lights.push_back({{"type", "environment"}, {"file", pictures.environment}, {"to_world", rows}});
    }
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
                instance.for_each([&](const TransformDescription& t) {
                    transforms.push_back(json_of(compose(to_transform(t), own)));
                });
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
    if (!scene.media.empty()) refuse(file, "a material absorbs, scatters or has a priority, or there is fog");
    for (size_t i = 0; i < d.meshes.size(); ++i) {
        if (!scene.shading[i].colors.empty()) refuse(d.meshes[i].where, "a mesh has colours of its vertices");
        if (!scene.shading[i].alphas.empty()) refuse(d.meshes[i].where, "a mesh has an alpha of its vertices");
        if (!scene.shading[i].second_uvs.empty())
            refuse(d.meshes[i].where, "a mesh has two sets of texture coordinates");
    }
    for (const Scene::Note& note : scene.divisions) refuse(note.where, "this mesh is divided to be displaced");
    if (scene.geometry.motion.moves() || !d.camera_path.empty())
        refuse(file, "something moves while the shutter is open (-D animation.shutter=0 closes it)");
    if (scene.background) refuse(d.background->where, "the background is not one colour");
    if (scene.glow) refuse(d.background->where, "lights are seen as discs");
    for (const RenderOption& option : render_options())
        if (option.is_switch() && is_biased(settings, option))
            refuse(file, std::string(option.name) + " is " + (value_text(settings, option) == "true" ? "on" : "off"));
}

std::string scene_json(const SceneDescription& d, const Scene& scene, const RenderSettings& settings,
                       const std::vector<std::string>& mesh_files, const ExportedPictures& pictures)
{
    Json materials = Json::array(), spheres = Json::array(), planes = Json::array();
    for (uint32_t id = 0; id < scene.materials.size(); ++id) materials.push_back(json_of_material(scene, id, pictures));
    for (size_t i = 0; i < d.spheres.size(); ++i)
        spheres.push_back({{"center", json_of(d.spheres[i].center)},
                           {"radius", d.spheres[i].radius},
                           {"material", scene.sphere_material[i]}});
    for (size_t i = 0; i < d.planes.size(); ++i) {
        const PlaneMap& map = scene.plane_maps[i];
        planes.push_back({{"point", json_of(d.planes[i].point)},
                          {"normal", json_of(normalize(d.planes[i].normal))},
                          {"material", scene.plane_material[i]},
                          {"uv", {{"origin", json_of(map.origin)}, {"u", json_of(map.u)}, {"v", json_of(map.v)}}}});
    }
    const Json all{{"schema", "lancer.scene/2"},
                   {"source", d.file},
                   {"size", {settings.size.width, settings.size.height}},
                   {"max_depth", settings.max_depth},
                   {"integrator", std::string(name_of(settings.integrator))},
                   {"filter", std::string(name_of(settings.filter))},
                   {"camera", json_of_camera(*d.camera)},
                   {"lights", json_of_lights(d, scene, pictures)},
                   {"textures", json_of_textures(scene, pictures)},
                   {"materials", materials},
                   {"meshes", json_of_meshes(d, mesh_files)},
                   {"spheres", spheres},
                   {"planes", planes}};
    // A file name need not be UTF-8; the text must be.
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lancer
