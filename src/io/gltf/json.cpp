#include "io/gltf/json.h"

#include <nlohmann/json.hpp>

namespace lancer {
namespace {

constexpr size_t deepest = 100;

// Receives what the parser finds. While a value is open nothing is added to the one around it, so pointers hold.
class JsonTree {
public:
    explicit JsonTree(JsonProblem& problem) : problem_(problem) {}
    JsonValue take() { return std::move(root_); }

    using string_t = std::string;
    bool null() { return put({nullptr}); }
    bool boolean(bool value) { return put({value}); }
    bool number_integer(int64_t value) { return put({static_cast<double>(value)}); }
    bool number_unsigned(uint64_t value) { return put({static_cast<double>(value)}); }
    bool number_float(double value, const string_t&) { return put({value}); }
    bool string(string_t& value) { return put({std::move(value)}); }
    bool binary(std::vector<uint8_t>&) { return false; }
    bool key(string_t& value)
    {
        std::get<JsonValue::Object>(open_.back()->data).push_back({std::move(value), {}});
        return true;
    }
    bool start_object(size_t) { return open({JsonValue::Object{}}); }
    bool end_object() { return close(); }
    bool start_array(size_t) { return open({JsonValue::Array{}}); }
    bool end_array() { return close(); }
    bool parse_error(size_t position, const std::string&, const nlohmann::json::exception& error)
    {
        const std::string text = error.what();
        const size_t colon = text.rfind(": ");
        const size_t bracket = text.find("] ");
        const bool is_syntax = text.find("syntax error") != std::string::npos;
        problem_ = {position, is_syntax && colon != std::string::npos ? text.substr(colon + 2)
                              : bracket != std::string::npos          ? text.substr(bracket + 2)
                                                                      : text};
        return false;
    }

private:
    JsonValue* add(JsonValue value)
    {
        if (open_.empty()) return &(root_ = std::move(value));
        if (auto* array = std::get_if<JsonValue::Array>(&open_.back()->data))
            return &array->emplace_back(std::move(value));
        return &(std::get<JsonValue::Object>(open_.back()->data).back().value = std::move(value));
    }
    bool put(JsonValue value)
    {
        add(std::move(value));
        return true;
    }
    bool open(JsonValue value)
    {
        if (open_.size() == deepest) {
            problem_ = {0, "values lie in values more than " + std::to_string(deepest) + " deep"};
            return false;
        }
        open_.push_back(add(std::move(value)));
        return true;
    }
    bool close()
    {
        open_.pop_back();
        return true;
    }

    JsonProblem& problem_;
    JsonValue root_;
    std::vector<JsonValue*> open_;
};

bool find_path(const JsonValue& at, const JsonValue& value, std::string& path)
{
    if (&at == &value) return true;
    const size_t before = path.size();
    if (const auto* array = std::get_if<JsonValue::Array>(&at.data)) {
        for (size_t i = 0; i < array->size(); ++i) {
            path += "[" + std::to_string(i) + "]";
            if (find_path((*array)[i], value, path)) return true;
            path.resize(before);
        }
    } else if (const auto* object = std::get_if<JsonValue::Object>(&at.data)) {
        for (const JsonMember& m : *object) {
            path += (before ? "." : "") + m.key;
            if (find_path(m.value, value, path)) return true;
            path.resize(before);
        }
    }
    return false;
}

}  // namespace

const JsonValue* JsonValue::member(std::string_view key) const
{
    if (const auto* object = std::get_if<Object>(&data))
        for (const JsonMember& m : *object)
            if (m.key == key) return &m.value;
    return nullptr;
}

std::optional<JsonValue> parse_json(std::string_view text, JsonProblem& problem)
{
    JsonTree tree(problem);
    if (!nlohmann::json::sax_parse(text.begin(), text.end(), &tree)) return {};
    return tree.take();
}

std::string path_of(const JsonValue& root, const JsonValue& value)
{
    std::string path;
    find_path(root, value, path);
    return path;
}

}  // namespace lancer
