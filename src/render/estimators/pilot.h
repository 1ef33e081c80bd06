// The pilot: a few samples before the first one estimate how much radiance parts of the picture have and where variance
// arises. The sampling plan follows from it.
#pragma once

#include <stop_token>

#include "integrators/path/path.h"
#include "integrators/path/sampling_plan.h"
#include "render/specialize.h"
#include "render/workspace.h"

namespace lancer {

// Computes the sampling plan of a picture. It depends on the scene, the camera, the size of the whole picture and the
// seed alone, so that it is the same for every crop, pass and number of threads. It uses at most 64 x 64 pixels with 16
// samples each, whose random numbers are not those of the picture, so that the picture stays unbiased. Must be called
// inside with_threads. If `stop` is requested it returns soon, and the result is of no use.
SamplingPlan make_plan(const Scene& scene, const Accelerator& accel, const Path& path, const KernelSettings& settings,
                       const KernelChoice& kernel, const Camera& camera, uint32_t width, uint32_t height,
                       const std::stop_token& stop = {});

// A plan and the picture for which it was computed.
struct Piloted {
    Camera camera;
    uint32_t width, height;
    SamplingPlan plan;
};

}  // namespace lancer
