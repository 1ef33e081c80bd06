// Pixels whose camera rays see nothing but a constant background, found before the first ray.
#pragma once

#include "integrators/path/sampling_plan.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace lancer {

// Fills SamplingPlan::background_only for a picture of this size. A cell is marked if no geometry lies within 2.5
// pixels of it, which includes the widest filter and all rounding errors; unmarked cells may be empty too. Nothing is
// marked if the background is not constant (environment map, media, planes), for cameras with a lens, and where the
// test would take longer than it saves.
void find_background_only(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height,
                          SamplingPlan& plan);

}  // namespace lancer
