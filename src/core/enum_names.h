// The names of an enumeration: what files, the command line, JSON and messages call its values. Each list stands once,
// beside its enumeration and in the order of its values:
//     enum class Shape { round, flat };
//     template <>
//     inline constexpr auto enum_names<Shape> = std::to_array<std::string_view>({"round", "flat"});
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace lancer {

template <class E>
inline constexpr std::nullptr_t enum_names = nullptr;

template <class E>
concept NamedEnum = std::is_enum_v<E> && requires
{
    enum_names<E>.size();
};

template <NamedEnum E>
constexpr std::string_view name_of(E value)
{
    return enum_names<E>[static_cast<size_t>(value)];
}

// The value of that name; nothing if there is none.
template <NamedEnum E>
constexpr std::optional<E> value_of(std::string_view name)
{
    const auto found = std::find(enum_names<E>.begin(), enum_names<E>.end(), name);
    if (found == enum_names<E>.end()) return {};
    return static_cast<E>(found - enum_names<E>.begin());
}

}  // namespace lancer
