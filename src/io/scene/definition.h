// A value of a scene file that the command line gives: "camera.fov=35", "light.0.radiance=[1, 2, 3]". It is inserted
// into the tree of values before tables are read, so that it is checked like a value of the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/toml_reader.h"

namespace lancer {

struct Definition {
    std::vector<std::string> path;  // keys, and indices into lists of tables; not empty
    std::string value;              // TOML, else a string
};

// Parts of the key are separated by dots; one with a dot in it is written in quotes. Throws Error (usage) where a text
// is not KEY=VALUE.
Definition parse_definition(std::string_view text);

// Puts the value at its path, over what is there; tables that are missing are made. A list of tables grows by one if
// the place is the one behind its end. What cannot be is a problem at `where`.
void define(TomlValue& root, const Definition& definition, TomlValue value, TomlProblems& problems);

// Marks a value and all within it as coming from a source, without line and column.
void set_source(TomlValue& value, uint32_t source);

}  // namespace lancer
