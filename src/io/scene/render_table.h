// [render] of a scene file: the options of a render, as scene/description/render_options.h lists them.
#pragma once

#include "io/toml_reader.h"
#include "scene/description/render_settings.h"

namespace lancer {

// Problems are collected in the table. What is not said keeps its default and is not marked as given.
RenderSettings read_render_table(const TomlTable& table);

}  // namespace lancer
