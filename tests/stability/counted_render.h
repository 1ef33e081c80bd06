// Renders of rows: what they take is added to the row's counts.
#pragma once

#include <bit>

#include "stability/row.h"
#include "support/render.h"

namespace lancer::stability {

// So many pixels a side and samples a pixel, on two threads.
RenderRequest square(uint32_t size, uint32_t spp);

Film counted_render(const SceneDescription& scene, const RenderRequest& request, Outcome& outcome);

// Pixels of which any bit of a sum differs; all, if the films are not of one size.
double pixels_that_differ(const Film& a, const Film& b);

}  // namespace lancer::stability
