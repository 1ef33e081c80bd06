// Vertex colours of OBJ files, an extension of MeshLab, Blender and scanners: "v x y z r g b". The parser of load_obj
// drops them, so they are read in a pass of their own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/color.h"
#include "core/error.h"

namespace lancer {

// The colours of the vertices of a text that passed scan_obj, in order, in [0, 1]; white where a vertex has none. Warns
// of invalid ones.
std::vector<Color> read_vertex_colors(std::string_view text, const std::string& file, Diagnostics& diagnostics);

}  // namespace lancer
