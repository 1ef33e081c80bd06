// The rows R that compare accelerators with a reference over many rays.
#pragma once

#include "stability/row.h"

namespace lancer::stability {

Outcome many_rays(const Setup& setup);
Outcome nearest_of_many(const Setup& setup);

}  // namespace lancer::stability
