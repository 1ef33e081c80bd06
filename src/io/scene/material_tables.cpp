#include "io/scene/material_tables.h"

#include "io/scene/texture_tables.h"
#include "scene/description/presets.h"

namespace lancer {
namespace {

const NameList type_names{"lambert", "mirror", "metal", "glass", "plastic", "mix", "interface"};  // as MaterialType

const NameList coloured{"lambert", "mirror", "metal", "glass", "plastic", "interface"};
const NameList rough{"metal", "glass", "plastic"};
const std::vector<TypedKey> typed_keys{{"base_color", coloured},
                                       {"texture", coloured},
                                       {"roughness", rough},
                                       {"roughness_texture", rough},
                                       {"metallic", {"metal", "plastic"}},
                                       {"metallic_texture", {"metal", "plastic"}},
                                       {"ior", {"glass", "plastic", "interface"}},
                                       {"absorption", {"glass", "interface"}},
                                       {"priority", {"glass", "interface"}},
                                       {"eta", {"metal"}},
                                       {"k", {"metal"}},
                                       {"specular", {"plastic", "interface"}},
                                       {"first", {"mix"}},
                                       {"second", {"mix"}},
                                       {"weight", {"mix"}},
                                       {"weight_texture", {"mix"}},
                                       {"ambient", {"interface"}},
                                       {"shininess", {"interface"}},
                                       {"diffusion", {"interface"}},
                                       {"reflexion", {"interface"}},
                                       {"refraction", {"interface"}},
                                       {"outside_ior", {"interface"}}};

// What one table says of a material; what it does not say is empty.
struct MaterialKeys {
    std::optional<MaterialType> type;
    std::optional<Color> base_color, eta, k, specular, absorption, emission, ambient;
    std::optional<float> roughness, metallic, ior, opacity, bump_scale, weight;
    std::optional<float> shininess, diffusion, reflexion, refraction, outside_ior;
    TextureUse base_color_map, roughness_map, metallic_map, opacity_map, bump_map, normal_map, emission_map, weight_map;
    std::optional<int32_t> priority;
    std::optional<bool> emission_both_sides;
    std::optional<std::string> first, second;
};

class MaterialReader {
public:
    MaterialReader(const TomlTable& root, const AssetFolder& assets, SceneDescription& scene)
        : root_(root), textures_(root, assets), scene_(scene)
    {
    }

    std::vector<NameUse> read()
    {
        for (const auto& [name, table] : root_.named_tables("material")) read_material(name, table);
        for (const TomlTable& table : root_.tables("material_override")) read_override(table);
        return std::move(uses_);
    }

private:
    MaterialKeys read_keys(const TomlTable& table, const NameList& also, std::optional<MaterialType> usual);
    void read_material(const std::string& name, const TomlTable& table);
    void read_override(const TomlTable& table);
    static MaterialDescription read_preset(const TomlTable& table);
    std::optional<std::string> read_name(const TomlTable& table, std::string_view key);

    const TomlTable& root_;
    const TextureTables textures_;
    SceneDescription& scene_;
    std::vector<NameUse> uses_;
};

std::optional<std::string> MaterialReader::read_name(const TomlTable& table, std::string_view key)
{
    const std::optional<std::string> name = table.text(key);
    if (name) uses_.push_back({table.where(key), *name});
    return name;
}

// usual: the type of a table that names none; nothing if it then depends on what the table is applied to.
MaterialKeys MaterialReader::read_keys(const TomlTable& table, const NameList& also, std::optional<MaterialType> usual)
{
    NameList known = also;
    known.push_back("type");
    for (const TypedKey& k : typed_keys) known.push_back(k.key);
    for (const char* key : {"opacity", "opacity_texture", "bump_texture", "bump_scale", "normal_texture", "emission",
                            "emission_texture", "emission_sides"})
        known.push_back(key);
    table.allow(known);

    MaterialKeys keys;
    keys.type = usual;
    if (table.has("type")) {
        const std::optional<size_t> type = table.choice("type", type_names, 0);
        keys.type = type ? std::optional(static_cast<MaterialType>(*type)) : std::nullopt;
    }
    if (keys.type) {
        const std::string_view type = type_names[static_cast<size_t>(*keys.type)];
        table.reject_keys_of_other_types(type, typed_keys);
        if (*keys.type == MaterialType::mix)
            for (const char* key : {"first", "second"}) table.require(key, type);
        // Without a colour what it reflects would be black, which nobody means who gives a part of it.
        if (*keys.type == MaterialType::interface && !table.has("preset"))
            for (const char* key : {"shininess", "reflexion", "refraction"})
                if (table.has(key) && !table.require("specular", type)) break;
        if (table.has("eta") != table.has("k")) table.require(table.has("k") ? "eta" : "k", type);
    }
    const auto number = [&](std::string_view key, const NumberRule& rule) {
        const std::optional<double> x = table.number(key, rule);
        return x ? std::optional(static_cast<float>(*x)) : std::nullopt;
    };
    keys.base_color = table.color("base_color", reflectance);
    keys.eta = table.color("eta", index_of_refraction);
    keys.k = table.color("k", brightness);
    keys.specular = table.color("specular", reflectance);
    keys.absorption = table.color("absorption", brightness);
    if (const auto n = table.integer("priority", -1'000'000, 1'000'000)) keys.priority = static_cast<int32_t>(*n);
    keys.emission = table.color("emission", brightness);
    keys.roughness = number("roughness", reflectance);
    keys.metallic = number("metallic", reflectance);
    keys.ior = number("ior", index_of_refraction);
    keys.opacity = number("opacity", reflectance);
    keys.bump_scale = number("bump_scale", float_range);
    keys.weight = number("weight", reflectance);
    keys.ambient = table.color("ambient", brightness);
    keys.shininess = number("shininess", brightness);
    keys.diffusion = number("diffusion", reflectance);
    keys.reflexion = number("reflexion", reflectance);
    keys.refraction = number("refraction", reflectance);
    keys.outside_ior = number("outside_ior", index_of_refraction);
    keys.base_color_map = textures_.use(table, "texture", TextureRole::color);
    keys.roughness_map = textures_.use(table, "roughness_texture", TextureRole::number);
    keys.metallic_map = textures_.use(table, "metallic_texture", TextureRole::number);
    keys.opacity_map = textures_.use(table, "opacity_texture", TextureRole::opacity);
    keys.bump_map = textures_.use(table, "bump_texture", TextureRole::number);
    if (keys.bump_map && keys.bump_map->type == TextureType::checker)
        table.error("bump_texture", " must be a picture: the squares of a checker have no slopes");
    if (keys.bump_map && keys.bump_map->type == TextureType::grid)
        table.error("bump_texture", " must be a picture: the bands of a grid have no slopes");
    keys.normal_map = textures_.use(table, "normal_texture", TextureRole::normal);
    keys.emission_map = textures_.use(table, "emission_texture", TextureRole::color);
    keys.weight_map = textures_.use(table, "weight_texture", TextureRole::number);
    if (table.has("emission_sides"))
        if (const auto sides = table.choice("emission_sides", {"front", "both"}, 0))
            keys.emission_both_sides = *sides == 1;
    keys.first = read_name(table, "first");
    keys.second = read_name(table, "second");
    return keys;
}

// Another type begins with its own defaults. The colour and the maps stay: they are what a mesh file knows best.
void change_type(MaterialDescription& m, MaterialType type)
{
    const MaterialDescription fresh;
    m.type = type;
    m.ior = fresh.ior;
    m.roughness = m.roughness_map ? 1 : fresh.roughness;
    m.eta = m.k = {};
    m.metallic = m.metallic_map ? std::optional(1.0f) : std::nullopt;
    m.specular = fresh.specular;
    m.phong = fresh.phong;
    m.phong.inside_ior = fresh.ior;
    m.absorption = fresh.absorption;
    m.priority = fresh.priority;
    m.weight = m.weight_map ? 1 : fresh.weight;
}

// What only an interface has; its index and its colour of reflection have the keys of other types.
void apply_interface(const MaterialKeys& keys, Phong& p)
{
    p.ambient = keys.ambient.value_or(p.ambient);
    p.specular = keys.specular.value_or(p.specular);
    p.shininess = keys.shininess.value_or(p.shininess);
    p.diffusion = keys.diffusion.value_or(p.diffusion);
    p.reflexion = keys.reflexion.value_or(p.reflexion);
    p.refraction = keys.refraction.value_or(p.refraction);
    p.inside_ior = keys.ior.value_or(p.inside_ior);
    p.outside_ior = keys.outside_ior.value_or(p.outside_ior);
}

// A texture whose own number is not said is not dimmed by it.
void apply(const MaterialKeys& keys, MaterialDescription& m)
{
    const Color white{1, 1, 1};
    const auto take_color = [&](const std::optional<Color>& said, const TextureUse& map, Color& value,
                                TextureUse& value_map) {
        if (map) value_map = map, value = white;
        value = said.value_or(value);
    };
    const auto take_number = [](const std::optional<float>& said, const TextureUse& map, auto& value,
                                TextureUse& value_map) {
        if (map) value_map = map, value = 1;
        if (said) value = *said;
    };
    take_color(keys.base_color, keys.base_color_map, m.base_color, m.base_color_map);
    take_color(keys.emission, keys.emission_map, m.emission, m.emission_map);
    take_number(keys.roughness, keys.roughness_map, m.roughness, m.roughness_map);
    take_number(keys.metallic, keys.metallic_map, m.metallic, m.metallic_map);
    take_number(keys.opacity, keys.opacity_map, m.opacity, m.opacity_map);
    take_number(keys.weight, keys.weight_map, m.weight, m.weight_map);
    if (keys.bump_map) m.bump_map = keys.bump_map;
    if (keys.normal_map) m.normal_map = keys.normal_map;
    m.bump_scale = keys.bump_scale.value_or(m.bump_scale);
    m.ior = keys.ior.value_or(m.ior);
    if (keys.eta && keys.k) m.eta = keys.eta, m.k = keys.k;
    m.specular = keys.specular.value_or(m.specular);
    m.absorption = keys.absorption.value_or(m.absorption);
    if (keys.priority) m.priority = keys.priority;
    m.emission_both_sides = keys.emission_both_sides.value_or(m.emission_both_sides);
    m.first = keys.first.value_or(m.first);
    m.second = keys.second.value_or(m.second);
    apply_interface(keys, m.phong);
}

// What a material that names a preset starts from; else the defaults.
MaterialDescription MaterialReader::read_preset(const TomlTable& table)
{
    MaterialDescription fresh;
    fresh.phong.inside_ior = fresh.ior;
    const std::optional<std::string> name = table.text("preset");
    if (!name) return fresh;
    if (const auto preset = find_preset(*name)) return *preset;
    table.error(table.where("preset"), "unknown preset " + in_quotes(*name) + suggestion(*name, names_of_presets()));
    return fresh;
}

void MaterialReader::read_material(const std::string& name, const TomlTable& table)
{
    const bool has_preset = table.has("preset");
    const MaterialKeys keys =
        read_keys(table, {"preset"}, has_preset ? MaterialType::interface : MaterialType::lambert);
    MaterialDescription m = read_preset(table);
    m.name = name;
    m.where = table.where();
    m.type = keys.type.value_or(m.type);
    // What nobody tinted loses no light by its tint.
    const bool is_tint = m.type == MaterialType::mirror || m.type == MaterialType::glass || keys.eta;
    if (is_tint) m.base_color = {1, 1, 1};
    apply(keys, m);
    if (has_preset && keys.type && *keys.type != MaterialType::interface)
        table.error("preset", " needs type 'interface', not " + in_quotes(type_names[static_cast<size_t>(*keys.type)]));
    scene_.materials.push_back(std::move(m));
}

void MaterialReader::read_override(const TomlTable& table)
{
    MaterialOverride change;
    change.where = table.where();
    if (table.require("match")) change.match = table.text("match").value_or("");
    change.material = read_name(table, "material").value_or("");
    const MaterialKeys keys = read_keys(table, {"match", "material"}, {});
    if (table.has("material") && !table.has_only({"match", "material"}))
        table.error("material",
                    " takes the place of a material as a whole: no other key than 'match' can stand beside it");
    change.change = [keys](const MaterialDescription& before) {
        MaterialDescription m = before;
        if (keys.type) change_type(m, *keys.type);
        apply(keys, m);
        return m;
    };
    scene_.overrides.push_back(std::move(change));
}

}  // namespace

std::vector<NameUse> read_materials(const TomlTable& root, const AssetFolder& assets, SceneDescription& scene)
{
    return MaterialReader(root, assets, scene).read();
}

}  // namespace lancer
