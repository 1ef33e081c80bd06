// Embree in its fast mode, which the product does not use as it loses rays: the negative control of rows about rays.
#pragma once

#include <memory>

#include "geometry/accel.h"

namespace lancer::stability {

// Meshes and instances alone. Hits are refined as the product does. The geometry must outlive it. Throws Error.
std::unique_ptr<Accelerator> make_fast_embree(const Geometry& geometry);

}  // namespace lancer::stability
