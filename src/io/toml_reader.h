// Reads the tables of a TOML file key by key. Every reader checks type and range of a value; problems are collected
// with their place, and the reader returns nothing. It does not depend on scenes.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/color.h"
#include "core/error.h"
#include "core/names.h"
#include "core/vec.h"
#include "io/toml_value.h"

namespace lancer {

using NameList = std::vector<std::string_view>;

// A key that only some types of an object have.
struct TypedKey {
    std::string_view key;
    NameList types;
};

// Range of a number; all must be finite.
struct NumberRule {
    bool (*holds)(double);
    const char* text;
};
inline constexpr NumberRule any_number{[](double) { return true; }, ""};
inline constexpr NumberRule not_zero{[](double x) { return x != 0; }, "other than 0"};
inline constexpr NumberRule above_zero{[](double x) { return x > 0; }, "greater than 0"};
inline constexpr NumberRule zero_or_more{[](double x) { return x >= 0; }, "0 or greater"};
inline constexpr NumberRule half_turn{[](double x) { return x > 0 && x < 180; }, "greater than 0 and less than 180"};
inline constexpr NumberRule below_one{[](double x) { return x >= -0.999 && x <= 0.999; }, "from -0.999 to 0.999"};
inline constexpr NumberRule up_to_quarter_turn{[](double x) { return x >= 0 && x <= 90; }, "from 0 to 90"};
inline constexpr NumberRule reflectance{[](double x) { return x >= 0 && x <= 1; }, "from 0 to 1"};
// These are stored as float.
inline constexpr NumberRule brightness{[](double x) { return x >= 0 && x <= std::numeric_limits<float>::max(); },
                                       "from 0 to 3.4e38"};
inline constexpr NumberRule float_range{
    [](double x) { return x >= -std::numeric_limits<float>::max() && x <= std::numeric_limits<float>::max(); },
    "from -3.4e38 to 3.4e38"};
inline constexpr NumberRule index_of_refraction{
    [](double x) { return x <= std::numeric_limits<float>::max() && static_cast<float>(x) > 0; },
    "greater than 0 and at most 3.4e38"};

// The problems of one file. Tables are read by kind; problems are reported from top to bottom.
class TomlProblems {
public:
    // sources: the file, then whatever else values come from; what TomlValue::source counts.
    explicit TomlProblems(std::vector<std::string> sources) : sources_(std::move(sources)) {}

    // Of a value or an entry.
    template <class T>
    Location where(const T& at) const
    {
        return {sources_[at.source], at.line, at.column};
    }
    void add(const Location& where, std::string message, ErrorKind kind = ErrorKind::invalid_input)
    {
        problems_.push_back({where, std::move(message), kind});
    }
    // note: behind each message.
    void report(Diagnostics& diagnostics, const std::string& note = "");
    bool has_any() const { return !problems_.empty(); }

private:
    struct Problem {
        Location where;
        std::string message;
        ErrorKind kind;
    };
    std::vector<std::string> sources_;
    std::vector<Problem> problems_;
};

// A table of the file. Every reader takes a key; if its value is wrong, it reports that and returns nothing.
class TomlTable {
public:
    // `value` must hold a table. The label stands in messages, as "[camera]"; empty for the whole file.
    TomlTable(const TomlValue& value, std::string label, TomlProblems& problems)
        : value_(&value), label_(std::move(label)), problems_(&problems)
    {
    }

    const std::string& label() const { return label_; }
    bool has(std::string_view key) const { return find(key) != nullptr; }
    Location where() const { return problems_->where(*value_); }
    bool holds_text(std::string_view key) const
    {
        return find(key) && std::holds_alternative<std::string>(find(key)->data);
    }
    // Of the value; of the table if it has no such key.
    Location where(std::string_view key) const
    {
        const TomlValue* value = find(key);
        return problems_->where(value ? *value : *value_);
    }
    void error(const Location& place, const std::string& message, ErrorKind kind = ErrorKind::invalid_input) const
    {
        problems_->add(place, message, kind);
    }
    // "'key' in [table] must be ..." or the like, at the value.
    void error(std::string_view key, const std::string& message) const { error(where(key), name(key) + message); }

    // Reports every other key as unknown.
    void allow(const NameList& known) const;
    // The same for keys that are not named tables, [table.NAME].
    void allow_besides_tables(const NameList& known) const;
    // Reports keys that do not apply to the table's type.
    void reject_keys_of_other_types(std::string_view type, const std::vector<TypedKey>& keys) const;
    // Reports a missing key; `type` explains why it is needed.
    bool require(std::string_view key, std::string_view type = "") const;

    std::optional<std::string> text(std::string_view key) const;
    // The place in `names` of the text at the key; `otherwise` if there is none.
    std::optional<size_t> choice(std::string_view key, const NameList& names, size_t otherwise) const;
    // From low to high, both included.
    std::optional<int64_t> integer(std::string_view key, int64_t low, int64_t high) const;
    std::optional<double> number(std::string_view key, const NumberRule& rule) const;
    std::optional<double> number(std::string_view key, double low, double high) const;  // as integer()
    std::optional<Vec3d> vector(std::string_view key, const NumberRule& rule = any_number) const;
    std::optional<Vec3d> number_or_vector(std::string_view key, const NumberRule& rule) const;
    std::optional<Vec2> number_or_pair(std::string_view key) const;  // in the range of float
    std::optional<bool> boolean(std::string_view key) const;
    std::optional<Color> color(std::string_view key, const NumberRule& rule) const;
    // A list of at least one list of four numbers, which `form` shows in messages; empty if it is wrong.
    std::vector<std::array<double, 4>> quadruples(std::string_view key, const char* form) const;
    std::optional<std::array<uint32_t, 2>> size(std::string_view key) const;
    // A list of at least one number; empty if it is wrong.
    std::vector<double> numbers(std::string_view key) const;
    // As it stands, of whatever type; null if there is none.
    const TomlValue* value(std::string_view key) const { return find(key); }
    std::optional<TomlTable> table(std::string_view key) const;                               // [key]
    std::vector<TomlTable> tables(std::string_view key) const;                                // [[key]]
    std::vector<std::pair<std::string, TomlTable>> named_tables(std::string_view key) const;  // [key.NAME]
    // The table at a key that may as well hold something else; nothing then.
    std::optional<TomlTable> inner_table(std::string_view key) const;
    // [table.NAME] in [table]; what else there is in it is passed over.
    std::vector<std::pair<std::string, TomlTable>> tables_within(std::string_view name_of_table) const;
    bool has_only_tables() const;
    bool has_only(const NameList& keys) const;

private:
    const TomlValue* value_;
    std::string label_;
    TomlProblems* problems_;

    const TomlValue* find(std::string_view key) const;
    std::string name(std::string_view key) const
    {
        return in_quotes(key) + (label_.empty() ? " at the top level" : " in " + label_);
    }
    void say_unknown(const TomlEntry& entry, const NameList& known) const;
    std::optional<int64_t> integer(const TomlValue& value, std::string_view key, int64_t low, int64_t high) const;
    std::optional<double> number(const TomlValue& value, std::string_view key, const NumberRule& rule) const;
};

}  // namespace lancer
