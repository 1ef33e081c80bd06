// An object of JSON, filled key by key, for results that programs read. Keys keep their order. Numbers that are not
// finite become null, bytes that are not UTF-8 are replaced.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lancer {

class JsonObject {
public:
    // schema: "lancer.check/1", the first key of results; "" for objects within others.
    explicit JsonObject(std::string_view schema = "");
    JsonObject(const JsonObject& other);
    JsonObject& operator=(const JsonObject& other);
    JsonObject(JsonObject&&) noexcept;
    JsonObject& operator=(JsonObject&&) noexcept;
    ~JsonObject();

    void text(std::string_view key, std::string_view value);
    void number(std::string_view key, double value);
    void count(std::string_view key, int64_t value);
    void flag(std::string_view key, bool value);
    void numbers(std::string_view key, std::span<const double> values);
    void counts(std::string_view key, std::span<const int64_t> values);
    void texts(std::string_view key, std::span<const std::string> values);
    void object(std::string_view key, const JsonObject& value);
    void objects(std::string_view key, std::span<const JsonObject> values);

    std::string to_text() const;  // indented, without a line feed at the end

private:
    struct Value;
    std::unique_ptr<Value> value_;
};

}  // namespace lancer
