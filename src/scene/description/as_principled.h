// A plainer material of a mesh file as the principled one that means the same, for files that say more of it.
#pragma once

#include "scene/description/material.h"

namespace lancer {

// Lambert, mirror, metal of a colour, glass and plastic; any other stays what it is, and the result is false. Layers
// that nothing said of are absent.
bool as_principled(MaterialDescription& material);

}  // namespace lancer
