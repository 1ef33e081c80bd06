// Rows C5 to C8, run; see rows/camera.cpp.
#pragma once

#include "stability/row.h"

namespace lancer::stability {

Outcome empty_scenes(const Setup& setup);
Outcome camera_on_things(const Setup& setup);
Outcome locales(const Setup& setup);
Outcome depths(const Setup& setup);

}  // namespace lancer::stability
