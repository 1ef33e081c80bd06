// Which switches change only how a picture is computed.
#pragma once

#include "core/switches.h"

namespace lancer {

// Whether a switch leaves the expected value of the picture unchanged.
constexpr bool is_technique(Switch x)
{
    return x == Switch::nee || x == Switch::mis || x == Switch::always_nee || x == Switch::light_tree ||
           x == Switch::split || x == Switch::roulette;
}

}  // namespace lancer
