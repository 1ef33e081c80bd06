// Reads a text file as a whole, and turns away what the parser of scene files must not see.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.h"

namespace lancer {

// Of a key, as "a.b.c" has three. Each makes a table, and tables in tables are freed by recursion: a hundred thousand
// would exhaust the stack.
inline constexpr size_t most_key_parts = 9;

// All bytes of the file. Throws Error if it is missing, a folder or unreadable.
std::string read_input_text(const std::string& path);

// Reports a text that is empty, binary, or has keys of too many parts.
// True if there is nothing to report.
bool check_toml_text(std::string_view text, const std::string& path, Diagnostics& diagnostics);

}  // namespace lancer
