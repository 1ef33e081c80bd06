// Settings, counters, memory and listeners of the kernels.
#pragma once

#include <optional>

#include "core/film.h"
#include "core/sampler.h"
#include "geometry/accel.h"
#include "integrators/path_actions.h"
#include "integrators/view.h"
#include "render/alpha_samples.h"
#include "render/estimators/stop_rule.h"
#include "render/filter.h"
#include "render/path_trails.h"
#include "render/profile.h"
#include "render/wide/states.h"
#include "scene/camera.h"

namespace lancer {

// Settings of a kernel.
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

// Working memory of a thread, reused from tile to tile.
struct Workspace {
    Queue queue;
    std::vector<PathState> states;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<uint8_t> occluded;
    std::vector<SampleId> slots;
    WideWorkspace wide;
    std::vector<Pixel> block;         // one per pixel of the tile
    std::vector<double> aov_block;    // the sums for AOVs of each, if there are any
    std::vector<Color> last;          // last sample of each pixel, for StopRule::last_sample
    std::vector<uint8_t> has_missed;  // for each slot whether its camera ray hit nothing; of Film::hides_background
    std::vector<RadianceSum> layers;  // of each slot its layers, if Film::layers has any
    PathTrails trails;                // of states, if the listener follows them
    QueueSizes queued;                // before the last vertex, likewise
    AlphaSamples alpha;               // of slots, if the film has AovSum::through or caught
    bool is_pilot = false;            // the samples are those of a pilot, with other random numbers

    uint64_t seed_of(const KernelSettings& settings, uint32_t path) const
    {
        const uint64_t seed = settings.seed_of(path);
        return is_pilot ? pilot_seed(seed) : seed;
    }
};

// Listeners receive the events of the paths of a batch, and the begin and end of each block of samples. This one
// ignores all events at no cost.
struct NoListener {
    void ray(const PathState&, const Hit&) const {}
    void background_only(const SampleId&) const {}  // instead of ray(), for samples that are not traced
    void vertex(const PathState&, const Surface&) const {}
    // Whether it takes the place of the integrator at a vertex.
    template <class V>
    static bool takes(const V&, const PathState&, const Surface&, const Sampler&)
    {
        return false;
    }
    // Whether the background that a ray has reached is not part of the picture.
    static bool hides_sky(const PathState&) { return false; }
    // After the integrator's turn at a vertex, or behind a surface that it was not called for.
    template <class V, class Integrator>
    void left(const V&, const Integrator&, const PathState&, const Surface&, const Sampler&) const
    {
    }
    void added(const PathState&, const Hit&, Color) const {}  // by a ray that hit something, or nothing
    void shadow(const ShadowEnds&, const Ray&, Color, bool /*occluded*/) const {}
    // A shadow ray by way of a mirror: the part that was stopped, or the last one.
    void mirrored_shadow(const ShadowEnds&, const Ray&, Color, bool) const {}
    void begin_samples() const {}  // those in Workspace::slots
    void end_samples() const {}
    void end_rays(Counters&) const {}  // all states have had their turn, with their shadow rays
    void begin_block(uint32_t /*first sample*/) const {}
    void end_block(uint32_t /*one past the last*/) const {}
};

}  // namespace lancer
