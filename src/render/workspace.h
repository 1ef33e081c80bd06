// What the pixel loop works with: its settings, its memory, what it counts and who listens.
#pragma once

#include <optional>

#include "core/film.h"
#include "core/sampler.h"
#include "geometry/accel.h"
#include "integrators/path_actions.h"
#include "integrators/view.h"
#include "render/estimators/stop_rule.h"
#include "render/filter.h"
#include "render/profile.h"
#include "render/wide/states.h"
#include "scene/camera.h"

namespace lancer {

// Everything but the place in the picture.
struct KernelSettings {
    SamplerKind sampler = SamplerKind::sobol;
    uint64_t seed = 0;
    Filter filter{FilterKind::blackman_harris};
    uint32_t batch = 256;              // paths under way at once, >= 1
    StopRule stop = StopRule::never;   // looked at only if the film has `wanted`
    double stop_error = 0.01;          // see samples_for()
    std::optional<Profile> profile{};  // rather than the plainest that covers the scene; ignored if it does not
    bool clamp = false;                // each sample to [0, 1] before it is averaged; legacy
    // Path i is number i / replicates of replicate i mod replicates, each of which has random numbers of its own: how
    // far they lie apart tells the error without a bias, at the price that each has fewer points to spread evenly.
    uint32_t replicates = 1;

    uint32_t replicate_of(uint32_t path) const { return replicates == 1 ? 0 : path % replicates; }
    uint32_t sample_of(uint32_t path) const { return replicates == 1 ? path : path / replicates; }
    // Of the first replicate that of a render without. No other one's is that of a seed nearby.
    uint64_t seed_of(uint32_t path) const
    {
        const uint64_t replicate = replicate_of(path);
        return replicate == 0 ? seed : mix_bits(seed ^ mix_bits(replicate));
    }
};

struct SampleId {
    uint32_t x = 0, y = 0, sample = 0;
    friend auto operator<=>(const SampleId&, const SampleId&) = default;
};

struct Counters {
    uint64_t camera_rays = 0, bounce_rays = 0, shadow_rays = 0;
    uint64_t background_only_samples = 0;   // of camera rays that were not traced: see SamplingPlan::background_only
    uint64_t dropped = 0;                   // samples that were not finite
    std::optional<SampleId> first_dropped;  // in order of x, y, sample

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

// Memory of one thread at work, kept from tile to tile.
struct Workspace {
    Queue queue;
    std::vector<PathState> states;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<uint8_t> occluded;
    std::vector<SampleId> slots;
    WideWorkspace wide;
    std::vector<Pixel> block;       // one per pixel of the tile
    std::vector<double> aov_block;  // the sums for AOVs of each, if there are any
    std::vector<Color> last;        // of each the last sample, if these decide when pixels end
    bool is_pilot = false;          // what is traced is not for the picture and has other random numbers

    uint64_t seed_of(const KernelSettings& settings, uint32_t path) const
    {
        const uint64_t seed = settings.seed_of(path);
        return is_pilot ? pilot_seed(seed) : seed;
    }
};

// Hears what happens to the paths of a batch, and when render_tile begins and ends a block of samples of its tile. This
// one hears nothing, at no cost.
struct NoListener {
    void ray(const PathState&, const Hit&) const {}
    void background_only(const SampleId&) const {}  // in place of ray(): nothing would be hit
    void vertex(const PathState&, const Surface&) const {}
    void added(const PathState&, Color) const {}
    void shadow(uint32_t /*slot*/, const Ray&, Color, bool) const {}
    void begin_block(uint32_t /*first sample*/) const {}
    void end_block(uint32_t /*one past the last*/) const {}
};

}  // namespace lancer
