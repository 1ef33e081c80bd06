// A mesh file of the source, written again elsewhere and in another size: for rows that must go through the loader.
#pragma once

#include <cstdio>
#include <sstream>

#include "io/obj/obj.h"
#include "io/temp_folder.h"
#include "support/scenes/scenes.h"

namespace lancer::stability {

// OBJ text with every position p at p * scale + shift, printed as `format` says; scale and shift in double.
std::string moved_obj(const std::string& text, double scale, Vec3d shift, const char* format);

std::string positions_text(const MeshData& mesh);
inline std::string face_text(const std::array<uint32_t, 3>& t)
{
    return "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
}

// Loads what must be right.
std::shared_ptr<const MeshData> load_right(const std::string& path);

// scenes/cornell.toml, its mesh written as moved_obj() does and read back.
SceneDescription moved_cornell(double scale, Vec3d shift, const char* format);

}  // namespace lancer::stability
