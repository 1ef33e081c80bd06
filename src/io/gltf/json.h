// JSON as a tree of values that remembers nothing of its text. Only json.cpp knows the library that parses it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lancer {

struct JsonMember;

struct JsonValue {
    using Array = std::vector<JsonValue>;
    using Object = std::vector<JsonMember>;

    std::variant<std::nullptr_t, bool, double, std::string, Array, Object> data;

    // Null if there is none, or if this is no object.
    const JsonValue* member(std::string_view key) const;
};

struct JsonMember {
    std::string key;
    JsonValue value;
};

struct JsonProblem {
    size_t position = 0;  // byte of the text
    std::string message;
};

// Nothing, and a problem, for what is no JSON or has values within values within values, more than 100 deep.
std::optional<JsonValue> parse_json(std::string_view text, JsonProblem& problem);

// "meshes[3].primitives[0]"; empty for the root itself and for what is not in its tree.
std::string path_of(const JsonValue& root, const JsonValue& value);

}  // namespace lancer
