// How a material lists its parameters: once, in the member `parameters` beside its data. Building from a description,
// reading scene files, folding of constants, export and the AOV of the base colour go over that list. What a key means
// (its range, whether a texture may multiply it) is a row of scene/description/material.h; a key without a
// row does not compile.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "materials/textures/texture.h"

namespace lancer {

template <class Member, class Default>
struct Parameter {
    std::string_view key;   // in scene files
    Member member;          // a pointer to the member that holds it, or a function of the material that returns it by
                            // reference; nullptr: the builder makes something else of it
    Default default_value;  // of this type of material; nullptr: that of the description
};
template <class Member = std::nullptr_t, class Default = std::nullptr_t>
constexpr Parameter<Member, Default> parameter(std::string_view key, Member member = {}, Default default_value = {})
{
    return {key, member, default_value};
}

// A member of a member.
template <class Outer, class Inner>
constexpr auto member_of(Outer outer, Inner inner)
{
    return [ outer, inner ](auto& m) -> auto& { return m.*outer.*inner; };
}

template <class P>
inline constexpr bool has_member = !std::is_same_v<decltype(std::declval<P>().member), std::nullptr_t>;
template <class P>
inline constexpr bool has_default = !std::is_same_v<decltype(std::declval<P>().default_value), std::nullptr_t>;

// Whether a texture may multiply a member of this type.
template <class Member>
inline constexpr bool is_textured =
    std::is_same_v<std::remove_cvref_t<Member>, ColorParam> || std::is_same_v<std::remove_cvref_t<Member>, FloatParam>;

// f(key, member) for every parameter that the material holds, in the order of its list.
template <class M, class F>
constexpr void for_each_parameter(M& material, const F& f)
{
    const auto visit = [&](const auto& p) {
        if constexpr (has_member<decltype(p)>) f(p.key, std::invoke(p.member, material));
    };
    std::apply([&](const auto&... p) { (visit(p), ...); }, std::remove_const_t<M>::parameters);
}
// The same for those alone that a texture may multiply: ColorParam and FloatParam.
template <class M, class F>
constexpr void for_each_textured_parameter(M& material, const F& f)
{
    for_each_parameter(material, [&](std::string_view, auto& member) {
        if constexpr (is_textured<decltype(member)>) f(member);
    });
}

// The place of a key in a tuple of things with keys; the tuple's size if it is not there.
template <class... P>
constexpr size_t index_of_key(const std::tuple<P...>& list, std::string_view key)
{
    return std::apply(
        [key](const auto&... p) {
            size_t i = 0;
            (void)((p.key == key || (++i, false)) || ...);
            return i;
        },
        list);
}

// The parameter "base_color", which every material has.
template <class M>
const ColorParam& base_color_of(const M& material)
{
    constexpr size_t i = index_of_key(M::parameters, "base_color");
    return std::invoke(std::get<i>(M::parameters).member, material);
}

}  // namespace lancer
