// Groups of lights, by which a picture can be split into layers: the light of each group, that comes straight from it
// or by any way. Lights, materials that emit and the sky name their group.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lancer {

struct LightGroups {
    static constexpr size_t most = 255;
    static constexpr std::string_view rest = "rest";  // of all that names no group

    std::vector<std::string> names{std::string(rest)};  // the others in the order in which they are first named
    // Indices in names:
    std::vector<uint8_t> of_material;  // parallel to Scene::materials
    std::vector<uint8_t> of_delta;     // parallel to Scene::delta_lights
    uint8_t of_sky = 0;

    // The index of a name, which is added if it is new; empty: the rest. There must be less than `most`.
    uint8_t index_of(const std::string& name)
    {
        if (name.empty()) return 0;
        const auto at = std::find(names.begin(), names.end(), name) - names.begin();
        if (static_cast<size_t>(at) == names.size()) names.push_back(name);
        return static_cast<uint8_t>(at);
    }
};

// Whether a name can be that of a group: letters, digits, _ and -, at most 64 of them, so that it can be a part of the
// names of a picture's channels.
inline bool is_group_name(std::string_view name)
{
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), fits);
}

}  // namespace lancer
