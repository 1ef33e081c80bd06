// Settings of the kernels.
#pragma once

#include <cstdint>
#include <optional>

#include "core/sampler.h"
#include "render/estimators/stop_rule.h"
#include "render/filter.h"
#include "render/profile.h"

namespace lancer {

struct KernelSettings {
    SamplerKind sampler = SamplerKind::sobol;
    uint64_t seed = 0;
    Filter filter{FilterKind::blackman_harris};
    uint32_t batch = 256;              // number of paths in a batch, >= 1
    StopRule stop = StopRule::never;   // used only if the film has `wanted`
    double stop_error = 0.01;          // see samples_for()
    std::optional<Profile> profile{};  // requested variant; ignored if it does not support the scene
    bool clamp = false;                // clamp samples to [0, 1]; legacy
    // Number of independent replicates. Path i has index i / replicates in replicate i mod replicates. Each replicate
    // has its own random numbers, so that their differences give an unbiased error estimate, at the price of fewer
    // points per low-discrepancy sequence.
    uint32_t replicates = 1;

    uint32_t replicate_of(uint32_t path) const { return replicates == 1 ? 0 : path % replicates; }
    uint32_t sample_of(uint32_t path) const { return replicates == 1 ? path : path / replicates; }
    // The seed of a path's replicate. The first replicate has the seed of a render without replicates.
    uint64_t seed_of(uint32_t path) const
    {
        const uint64_t replicate = replicate_of(path);
        return replicate == 0 ? seed : mix_bits(seed ^ mix_bits(replicate));
    }
};

}  // namespace lancer
