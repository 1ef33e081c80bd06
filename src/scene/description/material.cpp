#include "scene/description/material.h"

#include <algorithm>

#include "materials/material.h"

namespace lancer {
namespace {

template <class T>
constexpr bool holds_texture = std::is_same_v<std::remove_cvref_t<T>, TextureUse>;

// Every parameter of every type is a row, and every row is a parameter of some type or of all.
template <class M>
constexpr bool has_rows()
{
    return std::apply(
        [](const auto&... p) {
            return ((index_of_key(material_parameters, p.key) < std::tuple_size_v<decltype(material_rows::all)>)&&...);
        },
        M::parameters);
}
static_assert([] {
    bool all = has_rows<Emission>() && has_rows<MaterialTraits>();
    for_each_material_type([&]<class M> { all = all && has_rows<M>(); });
    return all;
}());
static_assert([] {
    bool all = true;
    for_each_material_parameter([&](const auto& row) {
        const auto lists = [&]<class M>(const M*) {
            return index_of_key(M::parameters, row.key) < std::tuple_size_v<decltype(M::parameters)>;
        };
        bool some = lists(static_cast<const Emission*>(nullptr)) || lists(static_cast<const MaterialTraits*>(nullptr));
        for_each_material_type([&]<class M> { some = some || lists(static_cast<const M*>(nullptr)); });
        all = all && some;
    });
    return all;
}());

}  // namespace

std::vector<const TextureUse*> textures_of(const MaterialDescription& m)
{
    std::vector<const TextureUse*> all;
    for_each_material_parameter([&](const auto& row) {
        if constexpr (has_map<decltype(row)>)
            all.push_back(&row.map_of(m));
        else if constexpr (holds_texture<decltype(row.value_of(m))>)
            all.push_back(&row.value_of(m));
    });
    return all;
}

std::vector<const TextureUse*> shading_textures_of(const MaterialDescription& m)
{
    std::vector<const TextureUse*> all = textures_of(m);
    std::erase(all, &m.displacement_map);
    return all;
}

bool reads_textures(const MaterialDescription& m)
{
    const std::vector<const TextureUse*> all = textures_of(m);
    return std::any_of(all.begin(), all.end(), [](const TextureUse* use) { return use->has_value(); });
}

std::vector<MaterialType> types_with(std::string_view key)
{
    std::vector<MaterialType> types;
    for_each_material_type([&]<class M> {
        if (index_of_key(M::parameters, key) < std::tuple_size_v<decltype(M::parameters)>) types.push_back(M::type);
    });
    std::sort(types.begin(), types.end());
    return types;
}

bool has_parameter(MaterialType type, std::string_view key)
{
    const std::vector<MaterialType> types = types_with(key);
    return types.empty() || std::find(types.begin(), types.end(), type) != types.end();
}

MaterialDescription default_description(MaterialType type)
{
    MaterialDescription m;
    m.type = type;
    for_each_material_type([&]<class M> {
        if (M::type != type) return;
        const auto take = [&]<size_t i>(std::integral_constant<size_t, i>) {
            constexpr auto p = std::get<i>(M::parameters);
            if constexpr (has_default<decltype(p)>)
                std::get<index_of_key(material_parameters, p.key)>(material_parameters).value_of(m) = p.default_value;
        };
        [&]<size_t... i>(std::index_sequence<i...>) { (take(std::integral_constant<size_t, i>{}), ...); }
        (std::make_index_sequence<std::tuple_size_v<decltype(M::parameters)>>{});
    });
    return m;
}

void change_type(MaterialDescription& m, MaterialType type)
{
    const MaterialDescription fresh = default_description(type);
    m.type = type;
    for_each_material_parameter([&](const auto& row) {
        if (row.key == "base_color" || types_with(row.key).empty()) return;
        row.value_of(m) = row.value_of(fresh);
        if constexpr (has_map<decltype(row)>)
            if (row.map_of(m)) set_to_one(row.value_of(m));
    });
}

}  // namespace lancer
