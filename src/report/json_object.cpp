#include "report/json_object.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace lancer {

struct JsonObject::Value {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
};

JsonObject::JsonObject(std::string_view schema) : value_(std::make_unique<Value>())
{
    if (!schema.empty()) text("schema", schema);
}
JsonObject::JsonObject(const JsonObject& other) : value_(std::make_unique<Value>(*other.value_)) {}
JsonObject& JsonObject::operator=(const JsonObject& other)
{
    *value_ = *other.value_;
    return *this;
}
JsonObject::JsonObject(JsonObject&&) noexcept = default;
JsonObject& JsonObject::operator=(JsonObject&&) noexcept = default;
JsonObject::~JsonObject() = default;

void JsonObject::text(std::string_view key, std::string_view value)
{
    value_->json[std::string(key)] = std::string(value);
}
void JsonObject::number(std::string_view key, double value)
{
    auto& json = value_->json[std::string(key)];
    if (std::isfinite(value)) json = value;
}
void JsonObject::count(std::string_view key, int64_t value) { value_->json[std::string(key)] = value; }
void JsonObject::flag(std::string_view key, bool value) { value_->json[std::string(key)] = value; }

void JsonObject::numbers(std::string_view key, std::span<const double> values)
{
    auto& json = value_->json[std::string(key)] = nlohmann::ordered_json::array();
    for (const double x : values) json.push_back(std::isfinite(x) ? nlohmann::ordered_json(x) : nullptr);
}
void JsonObject::counts(std::string_view key, std::span<const int64_t> values)
{
    auto& json = value_->json[std::string(key)] = nlohmann::ordered_json::array();
    for (const int64_t n : values) json.push_back(n);
}
void JsonObject::texts(std::string_view key, std::span<const std::string> values)
{
    auto& json = value_->json[std::string(key)] = nlohmann::ordered_json::array();
    for (const std::string& text : values) json.push_back(text);
}
void JsonObject::object(std::string_view key, const JsonObject& value)
{
    value_->json[std::string(key)] = value.value_->json;
}
void JsonObject::objects(std::string_view key, std::span<const JsonObject> values)
{
    auto& json = value_->json[std::string(key)] = nlohmann::ordered_json::array();
    for (const JsonObject& value : values) json.push_back(value.value_->json);
}

std::string JsonObject::to_text() const
{
    return value_->json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace lancer
