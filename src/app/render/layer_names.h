// Names of the layers of EXR pictures that other programs know.
#pragma once

#include <string>

#include "app/options/options.h"

namespace lancer {

// What a channel of ours is called by their names; as it is if they have none for it.
std::string layer_name(const std::string& channel, LayerNames names);

}  // namespace lancer
