// Plain values as the text of a TOML file: the opposite of io/toml_file.h.
#pragma once

#include <string>

#include "io/toml_value.h"

namespace lancer {

// root: a table. What is read back is equal: numbers have the same bits, and whole numbers stay whole. Tables and lists
// of tables at the first two levels have headers, as in [camera] and [material.NAME]; deeper ones stand on one line.
// path: of the table, if it is not the whole file; its own header is not written, and deeper tables stand on one line.
std::string to_toml_text(const TomlValue& root, const std::string& path = "");
// A value on one line.
std::string to_toml_value(const TomlValue& value);
// A key, with quotes where it needs them.
std::string to_toml_key(const std::string& key);
// Whether it is a list that headers as [[light]] can tell.
bool is_list_of_tables(const TomlValue& value);

// A text as a TOML string, with its quotes. Control characters are escaped; bytes that are not UTF-8 are kept.
std::string to_toml_string(const std::string& text);

}  // namespace lancer
