// What a picture says about its making: ordered pairs of name and value, kept in the header of the file.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace lancer {

using MetadataValue = std::variant<std::string, double, int64_t>;
using Metadata = std::vector<std::pair<std::string, MetadataValue>>;

// The value as text; a double in the fewest digits that give it back.
inline std::string to_string(const MetadataValue& value)
{
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* integer = std::get_if<int64_t>(&value)) return std::to_string(*integer);
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, std::get<double>(value)).ptr};
}

}  // namespace lancer
