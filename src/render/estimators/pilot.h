// A look at a picture before its first sample: how much light its parts show, and what makes a sample unsure. Of that
// follows how paths are to spend their rays.
#pragma once

#include "integrators/path/path.h"
#include "integrators/path/sampling_plan.h"
#include "render/workspace.h"

namespace lancer {

// The plan of a picture. It depends on the scene, the camera, the size of the whole picture and the seed alone: the
// same for every crop, shard and pass, and any number of threads. At most 64 x 64 pixels are looked at, with 16 samples
// of other random numbers than those that count, so that what is rendered by the plan stays unbiased. Call inside
// with_threads.
SamplingPlan make_plan(const Scene& scene, const Accelerator& accel, const Path& path, const KernelSettings& settings,
                       const Camera& camera, uint32_t width, uint32_t height);

// A plan, and of what picture.
struct Piloted {
    Camera camera;
    uint32_t width, height;
    SamplingPlan plan;
};

}  // namespace lancer
