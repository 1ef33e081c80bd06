// The list of integrators. A new one is a header, a word here and a file render/kernels_NAME.cpp.
#pragma once

#include <variant>

#include "integrators/direct.h"
#include "integrators/path.h"

namespace lancer {

using AnyIntegrator = std::variant<Path, Direct>;

}  // namespace lancer
