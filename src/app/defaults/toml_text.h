// Values as the text of scene files; what is read back has the same bits.
#pragma once

#include <string>

#include "core/color.h"
#include "core/vec.h"

namespace lancer {

std::string to_toml(Vec3d v);
std::string to_toml(Color c);

}  // namespace lancer
