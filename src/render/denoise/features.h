// What the denoiser fits colours by: properties of the first surface that spreads light, seen by way of mirrors and
// smooth glass. The kernel's listener asks for them; they cost rays of their own where a camera ray meets such a
// surface, and leave the paths of the picture alone.
#pragma once

#include "core/film.h"
#include "geometry/accel.h"
#include "integrators/path_actions.h"
#include "scene/scene.h"

namespace lancer {

// s: the path at its first hit, `surface`. Where a ray is both reflected and refracted, the mean of what both see.
SampleSet::Features features_seen(const Scene& scene, const Accelerator& accel, const PathState& s,
                                  const Surface& surface);

}  // namespace lancer
