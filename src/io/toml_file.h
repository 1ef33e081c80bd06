// TOML texts as plain values, each with its place.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "io/toml_value.h"

namespace lancer {

// The table that a file holds; nothing if it is none, which is then said with its place. path: for messages.
std::optional<TomlValue> parse_toml(std::string_view text, const std::string& path, Diagnostics& diagnostics);

// A value alone; a word that is no TOML is a string.
TomlValue parse_toml_value(const std::string& text);

}  // namespace lancer
