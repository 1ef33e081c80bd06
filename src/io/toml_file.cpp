#include "io/toml_file.h"

#include <toml++/toml.h>

#include <algorithm>
#include <utility>

#include "io/input_text.h"

namespace lancer {
namespace {

TomlValue to_value(const toml::node& node)
{
    const auto [begin, end, path] = node.source();
    TomlValue value{.line = begin.line,
                    .column = begin.column,
                    .data = TomlValue::Date{},
                    .end_line = end.line,
                    .end_column = end.column};
    if (const toml::table* table = node.as_table()) {
        TomlValue::Table entries;
        for (const auto& [key, child] : *table) {
            entries.push_back(
                {std::string(key.str()), key.source().begin.line, key.source().begin.column, to_value(child)});
        }
        // As written; toml++ sorts them by name.
        std::sort(entries.begin(), entries.end(), [](const TomlEntry& a, const TomlEntry& b) {
            return std::pair(a.line, a.column) < std::pair(b.line, b.column);
        });
        value.data = std::move(entries);
    } else if (const toml::array* array = node.as_array()) {
        TomlValue::Array elements;
        for (const toml::node& element : *array) elements.push_back(to_value(element));
        value.data = std::move(elements);
    } else if (const auto* text = node.as_string()) {
        value.data = text->get();
    } else if (const auto* integer = node.as_integer()) {
        value.data = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
        value.data = number->get();
    } else if (const auto* boolean = node.as_boolean()) {
        value.data = boolean->get();
    }
    return value;
}

// "Error while parsing array: ..." begins like an error of the program; it is one of the file.
std::string syntax_message(std::string_view description)
{
    const std::string_view prefix = "Error while parsing ";
    if (!description.starts_with(prefix)) return "invalid TOML: " + std::string(description);
    return "invalid TOML in " + std::string(description.substr(prefix.size()));
}

}  // namespace

std::optional<TomlValue> parse_toml(std::string_view text, const std::string& path, Diagnostics& diagnostics)
{
    if (!check_toml_text(text, path, diagnostics)) return {};
    try {
        return to_value(toml::parse(text));
    } catch (const toml::parse_error& e) {
        const toml::source_position at = e.source().begin;
        diagnostics.error({path, at.line, at.column}, syntax_message(e.description()));
        return {};
    }
}

TomlValue parse_toml_value(const std::string& text)
{
    const std::string key = "value = ";
    Diagnostics unheard;
    if (check_toml_text(key + text, "", unheard)) {
        try {
            const toml::table table = toml::parse(key + text);
            if (table.size() == 1) return to_value(*table.get("value"));
        } catch (const toml::parse_error&) {
        }
    }
    return {.data = text};
}

}  // namespace lancer
