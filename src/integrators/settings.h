// Settings of integrators. Each integrator reads the settings that it knows in a member take() and ignores the others.
#pragma once

#include <cstdint>

#include "core/switches.h"

namespace lancer {

struct IntegratorSettings {
    uint32_t max_depth = 0;  // surface vertices; 0: the integrator's own default
    Switches switches;
};

}  // namespace lancer
