// A TOML file as plain values with their places, made from toml++'s tree, so that readers do not depend on that
// library. A value may also come from the command line: `source` identifies it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lancer {

struct TomlEntry;

struct TomlValue {
    struct Date {};  // or time: no key takes one
    using Array = std::vector<TomlValue>;
    using Table = std::vector<TomlEntry>;

    uint32_t line = 0, column = 0;
    std::variant<Table, Array, std::string, int64_t, double, bool, Date> data;
    uint32_t source = 0;                    // 0: the file; else a text of the command line, see TomlProblems
    uint32_t end_line = 0, end_column = 0;  // behind its last character
};

struct TomlEntry {
    std::string key;
    uint32_t line = 0, column = 0;  // of the key
    TomlValue value;
    uint32_t source = 0;  // as of values
};

// The value of a key of a TomlValue::Table, const where the table is; null if it has none.
auto value_at(auto& table, std::string_view key) -> decltype(&table.begin()->value)
{
    const auto found = std::find_if(table.begin(), table.end(), [&](const TomlEntry& e) { return e.key == key; });
    return found == table.end() ? nullptr : &found->value;
}

}  // namespace lancer
