#include "io/scene/material_tables.h"

#include "io/scene/light_group.h"

#include <functional>

#include "io/scene/number_rule.h"
#include "io/scene/texture_tables.h"
#include "scene/description/material.h"
#include "scene/description/metals.h"
#include "scene/description/presets.h"

namespace lancer {
namespace {

NameList names_of_types() { return {enum_names<MaterialType>.begin(), enum_names<MaterialType>.end()}; }

// The keys that only some types have, those of their textures included.
const std::vector<TypedKey>& keys_of_materials()
{
    static const std::vector<TypedKey> all = [] {
        std::vector<TypedKey> keys;
        for_each_material_parameter([&](const auto& row) {
            NameList types;
            for (const MaterialType type : types_with(row.key)) types.push_back(name_of(type));
            if (types.empty()) return;
            keys.push_back({row.key, types});
            if constexpr (has_map<decltype(row)>) keys.push_back({row.map_key, types});
        });
        keys.push_back({"metal", {name_of(MaterialType::metal)}});
        return keys;
    }();
    return all;
}

// Of what is kept as float.
const NumberRule& rule_of(ParameterRange range) { return rule_of(range, index_of_refraction, float_range); }

// What one table says of a material: its type, if it says one, and what it changes of a description.
struct MaterialKeys {
    std::optional<MaterialType> type;
    std::vector<std::function<void(MaterialDescription&)>> changes;

    void apply_to(MaterialDescription& m) const
    {
        for (const auto& change : changes) change(m);
    }
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
    static void read_metal(const TomlTable& table, MaterialKeys& keys);
    std::optional<std::string> read_name(const TomlTable& table, std::string_view key);
    template <class Row>
    void read_parameter(const TomlTable& table, const Row& row, MaterialKeys& keys);
    template <class T, class Row>
    std::optional<T> read_value(const TomlTable& table, const Row& row);

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

// T: the type of the field, without the option to be nothing.
template <class T, class Row>
std::optional<T> MaterialReader::read_value(const TomlTable& table, const Row& row)
{
    if constexpr (std::is_same_v<T, Color>) {
        return table.color(row.key, rule_of(row.range));
    } else if constexpr (std::is_same_v<T, float>) {
        const std::optional<double> x = table.number(row.key, rule_of(row.range));
        return x ? std::optional(static_cast<float>(*x)) : std::nullopt;
    } else if constexpr (std::is_same_v<T, int32_t>) {
        const std::optional<int64_t> n = table.integer(row.key, -1'000'000, 1'000'000);
        return n ? std::optional(static_cast<int32_t>(*n)) : std::nullopt;
    } else if constexpr (std::is_same_v<T, bool>) {
        if (row.range == ParameterRange::boolean) return table.boolean(row.key);
        const std::optional<size_t> word =
            table.has(row.key) ? table.choice(row.key, {row.words.begin(), row.words.end()}, 0) : std::nullopt;
        return word ? std::optional(*word == 1) : std::nullopt;
    } else {
        static_assert(std::is_same_v<T, std::string>);
        return row.range == ParameterRange::group ? read_group(table) : read_name(table, row.key);
    }
}

// A texture whose own number is not said is not dimmed by it.
template <class Row>
void MaterialReader::read_parameter(const TomlTable& table, const Row& row, MaterialKeys& keys)
{
    using Field = std::remove_cvref_t<decltype(row.value_of(std::declval<MaterialDescription&>()))>;
    const auto change = [&](auto how) { keys.changes.emplace_back(std::move(how)); };
    if constexpr (std::is_same_v<Field, TextureUse>) {
        if (const TextureUse use = textures_.use(table, row.key, row.role))
            change([row, use](MaterialDescription& m) { row.value_of(m) = use; });
    } else {
        if constexpr (has_map<Row>)
            if (const TextureUse use = textures_.use(table, row.map_key, row.role))
                change([row, use](MaterialDescription& m) {
                    row.map_of(m) = use;
                    set_to_one(row.value_of(m));
                });
        using Value = std::remove_cvref_t<decltype(value_in(std::declval<Field&>()))>;
        if (const std::optional<Value> value = read_value<Value>(table, row))
            change([row, value](MaterialDescription& m) { row.value_of(m) = *value; });
    }
}

// usual: the type of a table that names none; nothing if it then depends on what the table is applied to.
MaterialKeys MaterialReader::read_keys(const TomlTable& table, const NameList& also, std::optional<MaterialType> usual)
{
    NameList known = also;
    known.push_back("type");
    for (const TypedKey& k : keys_of_materials()) known.push_back(k.key);
    for_each_material_parameter([&](const auto& row) {
        if (!types_with(row.key).empty()) return;
        known.push_back(row.key);
        if constexpr (has_map<decltype(row)>) known.push_back(row.map_key);
    });
    table.allow(known);

    MaterialKeys keys;
    keys.type = usual;
    if (table.has("type")) {
        const std::optional<size_t> type = table.choice("type", names_of_types(), 0);
        keys.type = type ? std::optional(static_cast<MaterialType>(*type)) : std::nullopt;
    }
    if (keys.type) {
        const std::string_view type = name_of(*keys.type);
        table.reject_keys_of_other_types(type, keys_of_materials());
        for_each_material_parameter([&](const auto& row) {
            if (row.range == ParameterRange::name && has_parameter(*keys.type, row.key)) table.require(row.key, type);
        });
        // Without a colour what it reflects would be black, which nobody means who gives a part of it.
        if (*keys.type == MaterialType::interface && !table.has("preset"))
            for (const char* key : {"shininess", "reflexion", "refraction"})
                if (table.has(key) && !table.require("specular", type)) break;
        if (table.has("eta") != table.has("k")) table.require(table.has("k") ? "eta" : "k", type);
    }
    for_each_material_parameter([&](const auto& row) { read_parameter(table, row, keys); });
    read_metal(table, keys);
    return keys;
}

// The indices of a metal that is named. As with indices that are given, it loses no light by its tint unless the table
// says so.
void MaterialReader::read_metal(const TomlTable& table, MaterialKeys& keys)
{
    const std::optional<std::string> name = table.text("metal");
    if (!name) return;
    const std::optional<MeasuredMetal> metal = find_metal(*name);
    if (!metal)
        return table.error(table.where("metal"),
                           "unknown metal " + in_quotes(*name) + suggestion(*name, names_of_metals()));
    for (const char* key : {"eta", "k"})
        if (table.has(key)) table.error(key, " is given by 'metal'");
    const bool is_tinted = table.has("base_color") || table.has("texture");
    keys.changes.emplace_back([metal, is_tinted](MaterialDescription& m) {
        m.eta = metal->eta, m.k = metal->k;
        if (!is_tinted) m.base_color = {1, 1, 1};
    });
}

// What a material that names a preset starts from.
MaterialDescription MaterialReader::read_preset(const TomlTable& table)
{
    const std::optional<std::string> name = table.text("preset");
    if (!name) return {};
    if (const auto preset = find_preset(*name)) return *preset;
    table.error(table.where("preset"), "unknown preset " + in_quotes(*name) + suggestion(*name, names_of_presets()));
    return {};
}

void MaterialReader::read_material(const std::string& name, const TomlTable& table)
{
    const bool has_preset = table.has("preset");
    const MaterialKeys keys =
        read_keys(table, {"preset"}, has_preset ? MaterialType::interface : MaterialType::lambert);
    const MaterialType type = keys.type.value_or(MaterialType::lambert);
    MaterialDescription m = has_preset ? read_preset(table) : default_description(type);
    m.name = name;
    m.where = table.where();
    m.type = type;
    // A conductor loses no light by its tint unless somebody says so.
    if (table.has("eta")) m.base_color = {1, 1, 1};
    keys.apply_to(m);
    if (has_preset && keys.type && *keys.type != MaterialType::interface)
        table.error("preset", " needs type 'interface', not " + in_quotes(name_of(*keys.type)));
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
        keys.apply_to(m);
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
