// Complex indices of refraction of metals, from published measurements, for `metal = "Au"` of a scene file.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/color.h"

namespace lancer {

struct MeasuredMetal {
    std::string_view symbol, name;  // "Au", "gold"; of an alloy both are its name
    Color eta, k;
};

// By symbol or name; nothing if there is none.
std::optional<MeasuredMetal> find_metal(std::string_view name);
// All symbols, then the names that differ from them.
std::vector<std::string_view> names_of_metals();

}  // namespace lancer
