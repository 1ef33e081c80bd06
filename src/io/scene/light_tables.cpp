#include "io/scene/light_tables.h"

#include "io/scene/light_group.h"
#include "io/scene/number_rule.h"

namespace lancer {
namespace {

NameList names_of(const std::vector<LightType>& types)
{
    NameList names;
    for (const LightType type : types) names.push_back(name_of(type));
    return names;
}

// Every key but the type, with the types of light that have it.
std::vector<TypedKey> keys_of_lights()
{
    std::vector<TypedKey> keys;
    for_each_light_parameter([&](const auto& row) { keys.push_back({row.key, names_of(row.types)}); });
    for (const char* key : {"file", "scale", "rotate"}) keys.push_back({key, names_of({LightType::environment})});
    return keys;
}

void read_field(const TomlTable& table, const LightParameter<Vec3d>& row, LightDescription& light)
{
    const std::optional<Vec3d> v = table.vector(row.key);
    if (!v) return;
    light.*row.field = *v;
    if (row.range == ParameterRange::nonzero_vector && *v == Vec3d{})
        table.error(row.key, " must not be the zero vector");
}
void read_field(const TomlTable& table, const LightParameter<double>& row, LightDescription& light)
{
    light.*row.field = table.number(row.key, rule_of(row.range, above_zero, any_number)).value_or(light.*row.field);
}
void read_field(const TomlTable& table, const LightParameter<Color>& row, LightDescription& light)
{
    light.*row.field = table.color(row.key, brightness).value_or(light.*row.field);
}

void read_picture(const TomlTable& table, const AssetFolder& assets, LightDescription& light)
{
    if (table.has("radiance")) table.error("radiance", " cannot stand beside 'file'; 'scale' is a factor on a picture");
    light.power = table.color("scale", brightness).value_or(Color{1, 1, 1});
    light.rotate_deg = table.vector("rotate").value_or(light.rotate_deg);
    const std::optional<std::string> name = table.text("file");
    if (!name) return;
    const AssetFolder::Found found = assets.find(*name);
    light.file = found.path;
    if (!found.problem.empty())
        table.error(table.where("file"), "picture " + in_quotes(*name) + " " + found.problem, found.kind);
}

}  // namespace

LightDescription read_light(const TomlTable& table, const AssetFolder& assets)
{
    const NameList types{enum_names<LightType>.begin(), enum_names<LightType>.end()};
    const std::vector<TypedKey> keys = keys_of_lights();
    NameList known{"type"};
    for (const TypedKey& k : keys) known.push_back(k.key);
    known.push_back("group");
    table.allow(known);

    LightDescription light;
    light.where = table.where();
    const std::optional<size_t> type = table.require("type") ? table.choice("type", types, 0) : std::nullopt;
    if (type) {
        light.type = static_cast<LightType>(*type);
        table.reject_keys_of_other_types(types[*type], keys);
        for_each_parameter_of(light.type, [&](const auto& row) {
            if (!(row.key == "radiance" && table.has("file"))) table.require(row.key, types[*type]);
        });
    }
    for_each_light_parameter([&](const auto& row) { read_field(table, row, light); });
    if (light.type == LightType::spot && light.inner_deg >= light.outer_deg && table.has("outer_angle"))
        table.error("outer_angle", " must be greater than 'inner_angle'");
    light.group = read_group(table).value_or("");
    if (table.has("file")) {
        read_picture(table, assets, light);
    } else {
        for (const char* key : {"scale", "rotate"})
            if (type && light.type == LightType::environment && table.has(key)) table.error(key, " needs 'file'");
    }
    return light;
}

}  // namespace lancer
