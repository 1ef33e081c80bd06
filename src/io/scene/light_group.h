// The key "group" of lights, materials and the background.
#pragma once

#include <optional>
#include <string>

#include "core/names.h"
#include "io/toml_file.h"
#include "scene/lights/groups.h"

namespace lancer {

inline std::optional<std::string> read_group(const TomlTable& table)
{
    std::optional<std::string> name = table.text("group");
    if (name && !is_group_name(*name))
        table.error(table.where("group"), "group " + in_quotes(*name) +
                                              " must have letters, digits, '_' and '-' alone, and at most 64 of them");
    return name;
}

}  // namespace lancer
