// The corners of faces in OBJ files, as words.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace lancer {

// The numbers of a corner i, i/j, i//k or i/j/k; those left out are empty. Nothing if there are more, or no i.
using CornerParts = std::array<std::string_view, 3>;
inline std::optional<CornerParts> split_corner(std::string_view corner)
{
    CornerParts parts;
    size_t part = 0, begin = 0;
    for (size_t i = 0; i <= corner.size(); ++i) {
        if (i < corner.size() && corner[i] != '/') continue;
        if (part == 3) return {};
        parts[part++] = corner.substr(begin, i - begin);
        begin = i + 1;
    }
    if (parts[0].empty()) return {};
    return parts;
}

// 0, as some programs write where there is nothing: 0, 00, -0.
inline bool is_zero(std::string_view digits)
{
    if (!digits.empty() && (digits[0] == '-' || digits[0] == '+')) digits.remove_prefix(1);
    return !digits.empty() && digits.find_first_not_of('0') == std::string_view::npos;
}

// Whether a corner's index of an attribute is one: it is not 0, and the file has such attributes at all.
inline bool refers(std::string_view digits, uint64_t there) { return !digits.empty() && there > 0 && !is_zero(digits); }

}  // namespace lancer
