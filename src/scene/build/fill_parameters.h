// From a description to the members that a material, or a part of one, lists as its parameters.
#pragma once

#include "materials/parameter.h"
#include "scene/description/material.h"

namespace lancer {

// Sets each parameter that `material` holds to what the description says, in the order of its list. id_of: the id of a
// texture.
template <class M, class IdOf>
void fill_parameters(M& material, const MaterialDescription& description, const IdOf& id_of)
{
    const auto fill = [&]<size_t i>(std::integral_constant<size_t, i>) {
        constexpr auto p = std::get<i>(M::parameters);
        constexpr size_t place = index_of_key(material_parameters, p.key);
        constexpr auto row = std::get<place>(material_parameters);
        if constexpr (has_member<decltype(p)>) {
            auto& member = std::invoke(p.member, material);
            const auto& said = row.value_of(description);
            if constexpr (has_map<decltype(row)> && std::is_same_v<decltype(said), const std::optional<float>&>)
                member = {said.value_or(0.0f), id_of(row.map_of(description))};
            else if constexpr (has_map<decltype(row)>)
                member = {said, id_of(row.map_of(description))};
            else if constexpr (std::is_same_v<decltype(said), const TextureUse&>)
                member = id_of(said);
            else
                member = said;
        }
    };
    [&]<size_t... i>(std::index_sequence<i...>) { (fill(std::integral_constant<size_t, i>{}), ...); }
    (std::make_index_sequence<std::tuple_size_v<decltype(M::parameters)>>{});
}

}  // namespace lancer
