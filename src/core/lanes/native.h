// Selects the operations of x86.h, or with LANCER_PORTABLE_LANES those of portable.h.
#pragma once

#ifdef LANCER_PORTABLE_LANES
#include "core/lanes/portable.h"
namespace lancer::native {
using namespace portable;
inline constexpr bool is_portable = true;
}  // namespace lancer::native
#else
#include "core/lanes/x86.h"
namespace lancer::native {
using namespace x86;
inline constexpr bool is_portable = false;
}  // namespace lancer::native
#endif

namespace lancer {
using namespace native;
}
