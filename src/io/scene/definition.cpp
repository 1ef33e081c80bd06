#include "io/scene/definition.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "io/input_text.h"

namespace lancer {
namespace {

bool is_place(std::string_view text)
{
    return !text.empty() && text.size() <= 9 &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string path_text(const std::vector<std::string>& path, size_t parts)
{
    std::string text;
    for (size_t i = 0; i < parts; ++i) text += (i ? "." : "") + path[i];
    return text;
}

// What stands at one part of the path; made if it may be, as if it stood where `origin` does. Null and a problem
// otherwise.
TomlValue* step(TomlValue& at, const Definition& definition, size_t part, const TomlValue& origin,
                TomlProblems& problems)
{
    const std::string& name = definition.path[part];
    const auto fail = [&](const std::string& message) {
        problems.add(problems.where(origin), message);
        return nullptr;
    };
    if (auto* table = std::get_if<TomlValue::Table>(&at.data)) {
        if (TomlValue* value = value_at(*table, name)) return value;
        // What follows a key that is not there tells whether it is a list; the name of a table may be a number, too.
        const bool is_list = part + 1 < definition.path.size() && is_place(definition.path[part + 1]) &&
                             name != "material" && name != "texture" && name != "camera";
        TomlValue made{.line = origin.line, .column = origin.column, .data = {}, .source = origin.source};
        if (is_list) made.data = TomlValue::Array{};
        table->push_back({.key = name,
                          .line = origin.line,
                          .column = origin.column,
                          .value = std::move(made),
                          .source = origin.source});
        return &table->back().value;
    }
    auto* array = std::get_if<TomlValue::Array>(&at.data);
    const std::string before = in_quotes(path_text(definition.path, part));
    if (!array) return fail(before + " is neither a table nor a list, so it has no " + in_quotes(name));
    if (!is_place(name)) return fail(before + " is a list: a number must follow, not " + in_quotes(name));
    size_t place = 0;
    std::from_chars(name.data(), name.data() + name.size(), place);
    if (place > array->size())
        return fail(before + " has no entry " + in_quotes(name) + ": they count from 0, and the next one would be " +
                    std::to_string(array->size()));
    if (place == array->size()) array->push_back({.data = TomlValue::Table{}, .source = origin.source});
    return &(*array)[place];
}

}  // namespace

Definition parse_definition(std::string_view text)
{
    Definition result;
    std::string part;
    bool was_quoted = false;
    const auto fail = [&] {
        throw Error(ErrorKind::usage, {},
                    "-D: " + in_quotes(text) + " is not KEY=VALUE, such as camera.fov=35 or light.0.radiance=[1,2,3]");
    };
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            const size_t end = text.find(c, i + 1);
            if (end == std::string_view::npos || !part.empty()) fail();
            part = text.substr(i + 1, end - i - 1);
            was_quoted = true;
            i = end;
        } else if (c == '.' || c == '=') {
            if (part.empty() && !was_quoted) fail();
            if (result.path.size() == most_key_parts)
                throw Error(ErrorKind::usage, {},
                            "-D: " + in_quotes(text.substr(0, 80)) + " has a key with more than " +
                                std::to_string(most_key_parts) + " parts");
            result.path.push_back(std::exchange(part, {}));
            was_quoted = false;
            if (c == '.') continue;
            result.value = text.substr(i + 1);
            if (result.value.empty()) fail();
            return result;
        } else if (c != ' ') {
            part += c;
        }
    }
    fail();
    return result;
}

void define(TomlValue& root, const Definition& definition, TomlValue value, TomlProblems& problems)
{
    TomlValue* at = &root;
    for (size_t i = 0; i < definition.path.size(); ++i) {
        at = step(*at, definition, i, value, problems);
        if (!at) return;
    }
    *at = std::move(value);
}

void set_source(TomlValue& value, uint32_t source)
{
    value.source = source;
    value.line = value.column = 0;
    if (auto* array = std::get_if<TomlValue::Array>(&value.data)) {
        for (TomlValue& element : *array) set_source(element, source);
    } else if (auto* table = std::get_if<TomlValue::Table>(&value.data)) {
        for (TomlEntry& entry : *table) {
            entry.source = source;
            entry.line = entry.column = 0;
            set_source(entry.value, source);
        }
    }
}

}  // namespace lancer
