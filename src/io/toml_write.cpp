#include "io/toml_write.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace lancer {
namespace {

std::string to_text(double x)
{
    if (std::isnan(x)) return "nan";
    if (std::isinf(x)) return x < 0 ? "-inf" : "inf";
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr;
    std::string text(digits.data(), end);
    // A decimal point must be followed by digits, and what has none would be read as a whole number.
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

struct InlineWriter {
    std::string operator()(const TomlValue::Table& table) const
    {
        std::string text;
        for (const TomlEntry& entry : table)
            text += (text.empty() ? "" : ", ") + to_toml_key(entry.key) + " = " + to_toml_value(entry.value);
        return "{" + text + "}";
    }
    std::string operator()(const TomlValue::Array& array) const
    {
        std::string text;
        for (const TomlValue& value : array) text += (text.empty() ? "" : ", ") + to_toml_value(value);
        return "[" + text + "]";
    }
    std::string operator()(const std::string& text) const { return to_toml_string(text); }
    std::string operator()(int64_t x) const { return std::to_string(x); }
    std::string operator()(double x) const { return to_text(x); }
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(TomlValue::Date) const { return "\"\""; }  // no key takes one: reading has failed
};

bool is_table(const TomlValue& value) { return std::holds_alternative<TomlValue::Table>(value.data); }

std::string entries_text(const TomlValue::Table& table, const std::string& path, int levels)
{
    std::string text, below;
    for (const auto& [key, line, column, value, source] : table) {
        const std::string name = to_toml_key(key), full = path.empty() ? name : path + "." + name;
        if (levels > 0 && is_table(value)) {
            const auto& inner = std::get<TomlValue::Table>(value.data);
            // Tables of tables, as [material], need no header.
            const bool has_own =
                levels == 1 || inner.empty() ||
                !std::all_of(inner.begin(), inner.end(), [](const TomlEntry& e) { return is_table(e.value); });
            below += (has_own ? "\n[" + full + "]\n" : "") + entries_text(inner, full, levels - 1);
        } else if (levels > 0 && is_list_of_tables(value)) {
            for (const TomlValue& element : std::get<TomlValue::Array>(value.data))
                below += "\n[[" + full + "]]\n" + entries_text(std::get<TomlValue::Table>(element.data), full, 0);
        } else {
            text += name + " = " + to_toml_value(value) + "\n";
        }
    }
    return text + below;
}

}  // namespace

std::string to_toml_text(const TomlValue& root, const std::string& path)
{
    return entries_text(std::get<TomlValue::Table>(root.data), path, path.empty() ? 2 : 1);
}

std::string to_toml_value(const TomlValue& value) { return std::visit(InlineWriter{}, value.data); }

std::string to_toml_key(const std::string& key)
{
    const auto is_plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    return !key.empty() && std::all_of(key.begin(), key.end(), is_plain) ? key : to_toml_string(key);
}

bool is_list_of_tables(const TomlValue& value)
{
    const auto* array = std::get_if<TomlValue::Array>(&value.data);
    return array && !array->empty() && std::all_of(array->begin(), array->end(), is_table);
}

std::string to_toml_string(const std::string& text)
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string quoted = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            quoted += '\\';
            quoted += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            quoted += "\\u00";
            quoted += digits[byte >> 4];
            quoted += digits[byte & 15];
        } else {
            quoted += c;
        }
    }
    return quoted + "\"";
}

}  // namespace lancer
