// Colours of vertices in OBJ files, an extension that MeshLab, Blender and scanners write: "v x y z r g b". The parser
// behind load_obj does not hand them on, so they are read here, in a walk of its own over files that have any.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/color.h"
#include "core/error.h"

namespace lancer {

// The colours of the vertices of a text that passed scan_obj, in order, each in [0, 1]; white where a vertex has none.
// Warns of what is no number, or lies outside.
std::vector<Color> read_vertex_colors(std::string_view text, const std::string& file, Diagnostics& diagnostics);

}  // namespace lancer
