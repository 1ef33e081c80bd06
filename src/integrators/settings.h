// What the user may say of an integrator. Each takes what it knows in a member take(); none is an error.
#pragma once

#include <cstdint>

#include "core/switches.h"

namespace lancer {

struct IntegratorSettings {
    uint32_t max_depth = 0;  // surface vertices; 0: the integrator's own default
    Switches switches;
};

}  // namespace lancer
