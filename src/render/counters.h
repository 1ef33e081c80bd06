// What the kernels count, and the name of a sample.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>

namespace lancer {

struct SampleId {
    uint32_t x = 0, y = 0, sample = 0;
    friend auto operator<=>(const SampleId&, const SampleId&) = default;
};

struct Counters {
    uint64_t camera_rays = 0, bounce_rays = 0, shadow_rays = 0;
    uint64_t background_only_samples = 0;   // samples without a traced ray; see SamplingPlan::background_only
    uint64_t dropped = 0;                   // samples that were not finite
    std::optional<SampleId> first_dropped;  // the first one in order of x, y, sample

    void drop(const SampleId& id)
    {
        ++dropped;
        if (!first_dropped || id < *first_dropped) first_dropped = id;
    }
    Counters& operator+=(const Counters& o)
    {
        camera_rays += o.camera_rays, bounce_rays += o.bounce_rays, shadow_rays += o.shadow_rays;
        background_only_samples += o.background_only_samples, dropped += o.dropped;
        if (o.first_dropped && (!first_dropped || *o.first_dropped < *first_dropped)) first_dropped = o.first_dropped;
        return *this;
    }
};

}  // namespace lancer
