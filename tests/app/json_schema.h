// Whether JSON has the form that a schema of docs/json says: the words of JSON Schema that these use.
#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lancer {

// What is wrong, each with its place; nothing if all is well. A word of the schema that is not known here is wrong.
inline std::vector<std::string> schema_faults(const nlohmann::json& schema, const nlohmann::json& value,
                                              const std::string& place = "$")
{
    using Json = nlohmann::json;
    std::vector<std::string> faults;
    const auto add = [&](std::vector<std::string> more) { faults.insert(faults.end(), more.begin(), more.end()); };
    const auto has_type = [&](const std::string& type) {
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "boolean") return value.is_boolean();
        if (type == "null") return value.is_null();
        // As JSON Schema has it, 2.0 is whole.
        if (type == "integer") return value.is_number() && value.get<double>() == std::trunc(value.get<double>());
        return type == "number" && value.is_number();
    };
    for (const auto& [word, rule] : schema.items()) {
        if (word == "$schema" || word == "title" || word == "description") continue;
        if (word == "type") {
            bool fits = false;
            for (const Json& type : rule.is_array() ? rule : Json::array({rule})) fits = fits || has_type(type);
            if (!fits) faults.push_back(place + " is no " + rule.dump() + ": " + value.dump());
        } else if (word == "const") {
            if (value != rule) faults.push_back(place + " is not " + rule.dump());
        } else if (word == "enum") {
            if (std::find(rule.begin(), rule.end(), value) == rule.end())
                faults.push_back(place + " is none of " + rule.dump());
        } else if (word == "minimum") {
            if (value.is_number() && value < rule) faults.push_back(place + " is below " + rule.dump());
        } else if (word == "minItems" || word == "maxItems") {
            if (value.is_array() && (word == "minItems" ? value.size() < rule : value.size() > rule))
                faults.push_back(place + " has " + std::to_string(value.size()) + " items, " + word + " " +
                                 rule.dump());
        } else if (word == "items") {
            for (size_t i = 0; value.is_array() && i < value.size(); ++i)
                add(schema_faults(rule, value[i], place + "[" + std::to_string(i) + "]"));
        } else if (word == "required") {
            for (const Json& key : rule)
                if (value.is_object() && !value.contains(key)) faults.push_back(place + " lacks " + key.dump());
        } else if (word == "properties") {
            for (const auto& [key, of_key] : rule.items())
                if (value.is_object() && value.contains(key)) add(schema_faults(of_key, value[key], place + "." + key));
        } else if (word == "additionalProperties") {
            const Json none = Json::object();
            for (const auto& [key, item] : (value.is_object() ? value : none).items()) {
                if (schema.contains("properties") && schema["properties"].contains(key)) continue;
                if (rule == false)
                    faults.push_back(place + " has the unknown key " + key);
                else
                    add(schema_faults(rule, item, place + "." + key));
            }
        } else if (word == "oneOf") {
            size_t fitting = 0;
            std::vector<std::string> why;
            for (const Json& one : rule) {
                const auto found = schema_faults(one, value, place);
                fitting += found.empty() ? 1 : 0;
                why.insert(why.end(), found.begin(), found.end());
            }
            if (fitting != 1) add(std::move(why));
        } else {
            faults.push_back("the schema has the unknown word " + word);
        }
    }
    return faults;
}

}  // namespace lancer
