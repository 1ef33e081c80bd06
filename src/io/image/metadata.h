// Metadata of a picture: ordered pairs of name and value, stored in the header of the file.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace lancer {

using MetadataValue = std::variant<std::string, double, int64_t>;
using Metadata = std::vector<std::pair<std::string, MetadataValue>>;

// The value as text; doubles with the fewest digits that read back as the same number.
inline std::string to_string(const MetadataValue& value)
{
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* integer = std::get_if<int64_t>(&value)) return std::to_string(*integer);
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, std::get<double>(value)).ptr};
}

// Null if there is none of that name.
inline const MetadataValue* find_value(const Metadata& metadata, std::string_view name)
{
    for (const auto& [key, value] : metadata)
        if (key == name) return &value;
    return nullptr;
}

// As text; "" if there is none of that name.
inline std::string text_of(const Metadata& metadata, std::string_view name)
{
    const MetadataValue* const found = find_value(metadata, name);
    return found ? to_string(*found) : "";
}

}  // namespace lancer
