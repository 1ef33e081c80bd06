#include "io/toml_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scene/description/description.h"

namespace lancer {
namespace {

std::string digits_of(double x)
{
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr};
}

std::string kind_of(const TomlValue& value)
{
    constexpr std::array kinds{"a table", "an array",  "a string",      "an integer",
                               "a float", "a boolean", "a date or time"};
    return kinds[value.data.index()];
}

const TomlValue::Array* as_array(const TomlValue& value) { return std::get_if<TomlValue::Array>(&value.data); }
const TomlValue::Table* as_table(const TomlValue& value) { return std::get_if<TomlValue::Table>(&value.data); }

std::optional<double> as_number(const TomlValue& value)
{
    if (const auto* x = std::get_if<double>(&value.data)) return *x;
    if (const auto* i = std::get_if<int64_t>(&value.data)) return static_cast<double>(*i);
    return {};
}

// What stands where an array of a certain length should: its length, or what it is instead of an array.
std::string count_or_kind(const TomlValue& value)
{
    const TomlValue::Array* array = as_array(value);
    return array ? std::to_string(array->size()) : kind_of(value);
}

}  // namespace

void TomlProblems::report(Diagnostics& diagnostics, const std::string& note)
{
    std::stable_sort(problems_.begin(), problems_.end(), [](const Problem& a, const Problem& b) {
        return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
    });
    for (const Problem& p : problems_) diagnostics.error(p.where, p.message + note, p.kind);
    problems_.clear();
}

const TomlValue* TomlTable::find(std::string_view key) const
{
    for (const TomlEntry& entry : *as_table(*value_)) {
        if (entry.key == key) return &entry.value;
    }
    return nullptr;
}

void TomlTable::say_unknown(const TomlEntry& entry, const NameList& known) const
{
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) return;
    const TomlValue::Array* array = as_array(entry.value);
    const bool is_table = as_table(entry.value) || (array && !array->empty() && as_table(array->front()));
    error(problems_->where(entry), (is_table && label_.empty() ? "unknown table " : "unknown key ") + name(entry.key) +
                                       suggestion(entry.key, known));
}

void TomlTable::allow(const NameList& known) const
{
    for (const TomlEntry& entry : *as_table(*value_)) say_unknown(entry, known);
}

void TomlTable::allow_besides_tables(const NameList& known) const
{
    for (const TomlEntry& entry : *as_table(*value_))
        if (!as_table(entry.value)) say_unknown(entry, known);
}

bool TomlTable::has_only_tables() const
{
    const TomlValue::Table& entries = *as_table(*value_);
    return !entries.empty() &&
           std::all_of(entries.begin(), entries.end(), [](const TomlEntry& e) { return as_table(e.value); });
}

bool TomlTable::has_only(const NameList& keys) const
{
    const TomlValue::Table& entries = *as_table(*value_);
    return std::all_of(entries.begin(), entries.end(),
                       [&](const TomlEntry& e) { return std::find(keys.begin(), keys.end(), e.key) != keys.end(); });
}

void TomlTable::reject_keys_of_other_types(std::string_view type, const std::vector<TypedKey>& keys) const
{
    for (const auto& [key, types] : keys) {
        if (!has(key) || std::find(types.begin(), types.end(), type) != types.end()) continue;
        std::string owners;
        for (const std::string_view owner : types) owners += (owners.empty() ? "" : " or ") + in_quotes(owner);
        error(key, " needs type " + owners + ", not " + in_quotes(type));
    }
}

bool TomlTable::require(std::string_view key, std::string_view type) const
{
    if (has(key)) return true;
    error(where(), label_ + (type.empty() ? "" : " of type " + in_quotes(type)) + " needs " + in_quotes(key));
    return false;
}

std::optional<std::string> TomlTable::text(std::string_view key) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    const auto* text = std::get_if<std::string>(&value->data);
    if (text && !text->empty()) return *text;
    error(key, text ? " must not be empty" : " must be a string, not " + kind_of(*value));
    return {};
}

std::optional<size_t> TomlTable::choice(std::string_view key, const NameList& names, size_t otherwise) const
{
    if (!has(key)) return otherwise;
    const std::optional<std::string> chosen = text(key);
    if (!chosen) return {};
    const auto found = std::find(names.begin(), names.end(), *chosen);
    if (found != names.end()) return static_cast<size_t>(found - names.begin());
    error(where(key),
          "unknown " + std::string(key) + " " + in_quotes(*chosen) + " in " + label_ + suggestion(*chosen, names));
    return {};
}

std::optional<int64_t> TomlTable::integer(const TomlValue& value, std::string_view key, int64_t low, int64_t high) const
{
    const auto* i = std::get_if<int64_t>(&value.data);
    if (i && *i >= low && *i <= high) return *i;
    const std::string range = "from " + std::to_string(low) + " to " + std::to_string(high);
    error(problems_->where(value),
          name(key) + " must be " + (i ? range + ", not " + std::to_string(*i) : "an integer, not " + kind_of(value)));
    return {};
}

std::optional<int64_t> TomlTable::integer(std::string_view key, int64_t low, int64_t high) const
{
    const TomlValue* value = find(key);
    return value ? integer(*value, key, low, high) : std::nullopt;
}

std::optional<double> TomlTable::number(const TomlValue& value, std::string_view key, const NumberRule& rule) const
{
    const std::optional<double> x = as_number(value);
    if (x && std::isfinite(*x) && rule.holds(*x)) return x;
    std::string must = "a number, not " + kind_of(value);
    if (x) must = (std::isfinite(*x) ? rule.text : "finite") + (", not " + digits_of(*x));
    error(problems_->where(value), name(key) + " must be " + must);
    return {};
}

std::optional<double> TomlTable::number(std::string_view key, const NumberRule& rule) const
{
    const TomlValue* value = find(key);
    return value ? number(*value, key, rule) : std::nullopt;
}

std::optional<double> TomlTable::number(std::string_view key, double low, double high) const
{
    const std::optional<double> x = number(key, any_number);
    if (!x || (*x >= low && *x <= high)) return x;
    error(key, " must be from " + digits_of(low) + " to " + digits_of(high) + ", not " + digits_of(*x));
    return {};
}

std::optional<Vec3d> TomlTable::vector(std::string_view key, const NumberRule& rule) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    const TomlValue::Array* array = as_array(*value);
    if (!array || array->size() != 3) {
        error(key, " must be three numbers, not " + count_or_kind(*value));
        return {};
    }
    const std::optional<double> x = number((*array)[0], key, rule);
    const std::optional<double> y = number((*array)[1], key, rule);
    const std::optional<double> z = number((*array)[2], key, rule);
    if (!x || !y || !z) return {};
    return Vec3d{*x, *y, *z};
}

std::optional<Vec3d> TomlTable::number_or_vector(std::string_view key, const NumberRule& rule) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    if (as_number(*value)) {
        const std::optional<double> x = number(*value, key, rule);
        return x ? std::optional(Vec3d{*x, *x, *x}) : std::nullopt;
    }
    if (as_array(*value)) return vector(key, rule);
    error(key, " must be one number or three, not " + kind_of(*value));
    return {};
}

std::optional<Vec2> TomlTable::number_or_pair(std::string_view key) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    const TomlValue::Array* array = as_array(*value);
    if (!as_number(*value) && (!array || array->size() != 2)) {
        error(key, " must be one number or two, not " + count_or_kind(*value));
        return {};
    }
    const std::optional<double> x = number(array ? (*array)[0] : *value, key, float_range);
    const std::optional<double> y = array ? number((*array)[1], key, float_range) : x;
    if (!x || !y) return {};
    return Vec2{static_cast<float>(*x), static_cast<float>(*y)};
}

std::optional<bool> TomlTable::boolean(std::string_view key) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    const bool* b = std::get_if<bool>(&value->data);
    if (b) return *b;
    error(key, " must be true or false, not " + kind_of(*value));
    return {};
}

std::optional<Color> TomlTable::color(std::string_view key, const NumberRule& rule) const
{
    const std::optional<Vec3d> v = number_or_vector(key, rule);
    if (!v) return {};
    const Vec3 rgb = to_float(*v);
    return Color{rgb.x, rgb.y, rgb.z};
}

std::vector<std::array<double, 4>> TomlTable::quadruples(std::string_view key, const char* form) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    const TomlValue::Array* list = as_array(*value);
    if (!list || list->empty()) {
        error(key, std::string(" must be a list of ") + form + ", not " + (list ? "empty" : kind_of(*value)));
        return {};
    }
    std::vector<std::array<double, 4>> result;
    for (const TomlValue& element : *list) {
        const TomlValue::Array* numbers = as_array(element);
        if (!numbers || numbers->size() != 4) {
            error(problems_->where(element),
                  name(key) + " must be a list of " + form + ": four numbers each, not " + count_or_kind(element));
            return {};
        }
        auto& four = result.emplace_back();
        for (size_t i = 0; i < 4; ++i) {
            const std::optional<double> x = number((*numbers)[i], key, any_number);
            if (!x) return {};
            four[i] = *x;
        }
    }
    return result;
}

std::optional<std::array<uint32_t, 2>> TomlTable::size(std::string_view key) const
{
    constexpr int64_t max_side = max_picture_side, max_pixels = max_picture_pixels;
    const TomlValue* value = find(key);
    if (!value) return {};
    const TomlValue::Array* array = as_array(*value);
    if (!array || array->size() != 2) {
        error(key, " must be two integers, width and height, not " + count_or_kind(*value));
        return {};
    }
    const std::optional<int64_t> width = integer((*array)[0], key, 1, max_side);
    const std::optional<int64_t> height = integer((*array)[1], key, 1, max_side);
    if (!width || !height) return {};
    if (*width * *height > max_pixels) {
        error(key, " must make at most 268435456 pixels, not " + std::to_string(*width * *height));
        return {};
    }
    return std::array{static_cast<uint32_t>(*width), static_cast<uint32_t>(*height)};
}

std::vector<double> TomlTable::numbers(std::string_view key) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    const TomlValue::Array* list = as_array(*value);
    if (!list || list->empty()) {
        error(key, " must be a list of numbers, not " + (list ? "empty" : kind_of(*value)));
        return {};
    }
    std::vector<double> result;
    for (const TomlValue& element : *list) {
        const std::optional<double> x = number(element, key, any_number);
        if (!x) return {};
        result.push_back(*x);
    }
    return result;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    const std::string heading = "[" + std::string(key) + "]";
    if (as_table(*value)) return TomlTable(*value, heading, *problems_);
    error(key, " must be one table, written " + heading + ", not " + kind_of(*value));
    return {};
}

std::optional<TomlTable> TomlTable::inner_table(std::string_view key) const
{
    const TomlValue* value = find(key);
    if (!value || !as_table(*value)) return {};
    return TomlTable(*value, in_quotes(key) + (label_.empty() ? "" : " in " + label_), *problems_);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    const std::string heading = "[[" + std::string(key) + "]]";
    const TomlValue::Array* array = as_array(*value);
    if (!array) {
        error(key, " must be a list of tables, each written " + heading + ", not " + kind_of(*value));
        return {};
    }
    std::vector<TomlTable> tables;
    for (const TomlValue& element : *array) {
        if (as_table(element)) {
            tables.emplace_back(element, heading, *problems_);
        } else {
            error(problems_->where(element), heading + " must be a table, not " + kind_of(element));
        }
    }
    return tables;
}

std::vector<std::pair<std::string, TomlTable>> TomlTable::named_tables(std::string_view key) const
{
    const TomlValue* value = find(key);
    if (!value) return {};
    const std::string prefix = "[" + std::string(key) + ".";
    if (!as_table(*value)) {
        error(key, " must be tables, each written " + prefix + "NAME], not " + kind_of(*value));
        return {};
    }
    std::vector<std::pair<std::string, TomlTable>> tables;
    for (const TomlEntry& entry : *as_table(*value)) {
        if (entry.key.empty()) {
            error(problems_->where(entry), prefix + "NAME] needs a name that is not empty");
        } else if (as_table(entry.value)) {
            tables.emplace_back(entry.key, TomlTable(entry.value, prefix + on_one_line(entry.key) + "]", *problems_));
        } else {
            error(problems_->where(entry), in_quotes(entry.key) + " in [" + std::string(key) +
                                               "] must be a table, written " + prefix + "NAME], not " +
                                               kind_of(entry.value));
        }
    }
    return tables;
}

std::vector<std::pair<std::string, TomlTable>> TomlTable::tables_within(std::string_view name_of_table) const
{
    std::vector<std::pair<std::string, TomlTable>> tables;
    for (const TomlEntry& entry : *as_table(*value_)) {
        if (!as_table(entry.value)) continue;
        const std::string label = "[" + std::string(name_of_table) + "." + on_one_line(entry.key) + "]";
        tables.emplace_back(entry.key, TomlTable(entry.value, label, *problems_));
    }
    return tables;
}

}  // namespace lancer
