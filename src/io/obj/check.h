// Notes of `lancer check` on an OBJ file that is valid.
#pragma once

#include <string>

#include "core/error.h"

namespace lancer {

// Polygons of more than four corners, which are cut into triangles, and libraries that are named more than once.
// A file that cannot be read has no notes.
void check_obj_text(const std::string& path, Diagnostics& notes);

}  // namespace lancer
