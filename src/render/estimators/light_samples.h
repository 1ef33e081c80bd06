// How many light samples a path takes at its first vertex that is not specular: measured on direct light alone.
#pragma once

#include <span>
#include <stop_token>

#include "integrators/path/path.h"
#include "integrators/path/sampling_plan.h"
#include "render/specialize.h"
#include "render/workspace.h"

namespace lancer {

// What a pilot knows of paths with one light sample, per camera ray. Variances are relative to the square of the
// pixel's radiance; work is in units of a bounce ray.
struct PathCost {
    double below;        // what arises behind it, with the rays into which the path splits
    double camera;       // work of a camera ray
    double shadow;       // of a shadow ray
    double split;        // rays into which a path splits
    double bounces = 0;  // behind each of these
    double shadows = 0;  // of the whole path if it does not split, those at its first vertex included
};

// A pixel of a pilot and the square of its radiance, 0 if it is not to count.
struct PilotPixel {
    uint32_t x, y;
    double square;
};

// 1, 2 or 4: the number with the lowest variance for the work. plan: of the picture; width: of the picture. Must be
// called inside with_threads; the result does not depend on the number of threads. If `stop` is
// requested it returns soon, and the result is of no use.
uint32_t best_light_samples(const Scene& scene, const Accelerator& accel, const Path& path,
                            const KernelSettings& settings, const KernelChoice& kernel, const Camera& camera,
                            uint32_t width, const SamplingPlan& plan, std::span<const PilotPixel> pixels,
                            const PathCost& cost, const std::stop_token& stop);

}  // namespace lancer
