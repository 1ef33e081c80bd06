// Which parts of a picture see nothing but a sky of one colour, whatever the samples: known before the first ray.
#pragma once

#include "integrators/path/sampling_plan.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace lancer {

// Fills SamplingPlan::background_only for a picture of this size. Where it says 1 there is no geometry within 2.5
// pixels, the widest filter and all roundings included; of other pixels it says nothing. It stays empty where no two
// rays that meet nothing are sure to see the same (a picture as the sky, media, planes), for lenses, and where to look
// would take longer than it saves.
void find_background_only(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height,
                          SamplingPlan& plan);

}  // namespace lancer
