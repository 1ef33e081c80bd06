// How much of a render passes inside of its accelerator: by a clock around each of the kernel's calls, as a profiler
// would see it. What the rest of the render does to the caches counts where it is felt.
#pragma once

#include "harness/stage.h"

namespace lancer::bench {

struct RenderTime {
    double all = 0, inside = 0;  // ns on the clock
    double share() const { return inside / all; }
};

// Of the whole picture with samples [0, spp), by the calling thread alone. What is made once for all passes, such as
// the plan, is left out.
RenderTime clock_render(const Stage& stage, uint32_t spp);

}  // namespace lancer::bench
