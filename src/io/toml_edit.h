// A TOML text that says something else now, with its comments and its order kept.
#pragma once

#include <optional>
#include <string>

#include "io/toml_value.h"

namespace lancer {

// `text`, changed in as few places as it takes to say what `root`, a table, says: values are replaced where they stand,
// new keys follow those of their table, new tables come last. Nothing if that cannot be done, as where a table is gone;
// what is returned has been read back and says the same as `root`.
std::optional<std::string> edited_toml_text(const std::string& text, const TomlValue& root);

}  // namespace lancer
