// What a [[light]] of a scene file says, and its keys, each with the types of light that have it. Scene files, export
// and the table of docs/scene-format.md, which a test compares, go over these rows.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/color.h"
#include "core/enum_names.h"
#include "core/error.h"
#include "core/vec.h"
#include "scene/description/parameter_range.h"

namespace lancer {

// The environment is the last one: there is one light for all that are said.
enum class LightType : uint8_t { point, directional, spot, sphere, environment };

template <>
inline constexpr auto enum_names<LightType> = std::to_array<std::string_view>({"point", "directional", "spot", "sphere",
                                                                               "environment"});
static_assert(static_cast<size_t>(LightType::environment) + 1 == enum_names<LightType>.size());

struct LightDescription {
    Location where;
    LightType type = LightType::point;
    Vec3d position{};  // point, spot; center of sphere
    Vec3d direction{
        0, -1, 0};  // directional, spot: the way that the light goes, or its middle; finite, not zero, need not be unit
    double radius = 1;                     // sphere
    double inner_deg = 0, outer_deg = 45;  // spot: angles to its middle at which it begins to fade, and is dark
    Color power{};  // intensity (point, spot in its middle), irradiance on a surface that faces it (directional),
                    // radiance (sphere, environment; with a file its factor); finite, >= 0
    std::string file{};         // environment: latitude-longitude picture; empty: constant
    Vec3d rotate_deg{0, 0, 0};  // environment with a file: about x, then y, then z
    std::string group{};        // of lights, see scene/lights/groups.h; empty: none
};

// Each must be given.
template <class Field>
struct LightParameter {
    std::string_view key;
    Field LightDescription::*field;
    ParameterRange range;
    std::vector<LightType> types;
};
template <class Field>
LightParameter(std::string_view, Field LightDescription::*, ParameterRange, std::vector<LightType>)
    -> LightParameter<Field>;

// f(row) for each.
template <class F>
void for_each_light_parameter(const F& f)
{
    using L = LightDescription;
    using enum LightType;
    using enum ParameterRange;
    f(LightParameter{"position", &L::position, finite, {point, spot}});
    f(LightParameter{"intensity", &L::power, not_negative, {point, spot}});
    f(LightParameter{"direction", &L::direction, nonzero_vector, {directional, spot}});
    f(LightParameter{"irradiance", &L::power, not_negative, {directional}});
    f(LightParameter{"inner_angle", &L::inner_deg, quarter_turn, {spot}});
    f(LightParameter{"outer_angle", &L::outer_deg, quarter_turn, {spot}});
    f(LightParameter{"center", &L::position, finite, {LightType::sphere}});
    f(LightParameter{"radius", &L::radius, positive, {LightType::sphere}});
    f(LightParameter{"radiance", &L::power, not_negative, {LightType::sphere, environment}});
}
// f(row) for each parameter of one type of light.
template <class F>
void for_each_parameter_of(LightType type, const F& f)
{
    for_each_light_parameter([&](const auto& row) {
        if (std::find(row.types.begin(), row.types.end(), type) != row.types.end()) f(row);
    });
}

}  // namespace lancer
