// Which switches say how a picture is found, and not what it is.
#pragma once

#include "core/switches.h"

namespace lancer {

// Whether a switch leaves the mean of the picture alone.
constexpr bool is_technique(Switch x)
{
    return x == Switch::nee || x == Switch::mis || x == Switch::always_nee || x == Switch::light_tree ||
           x == Switch::split || x == Switch::roulette;
}

}  // namespace lancer
