// Memory and listeners of the kernels.
#pragma once

#include <vector>

#include "core/film.h"
#include "core/sampler.h"
#include "geometry/accel.h"
#include "integrators/path_actions.h"
#include "render/alpha_samples.h"
#include "render/counters.h"
#include "render/kernel_settings.h"
#include "render/path_trails.h"
#include "render/wide/queues.h"
#include "render/wide/states.h"
#include "scene/camera.h"

namespace lancer {

// Working memory of a thread, reused from tile to tile.
struct Workspace {
    Queue queue;
    std::vector<PathState> states;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<uint8_t> occluded;
    std::vector<SampleId> slots;
    WideWorkspace wide;
    MaterialQueues queues;          // of the wide kernel
    std::vector<Pixel> block;       // one per pixel of the tile
    std::vector<double> aov_block;  // the sums for AOVs of each, if there are any
    // Of each slot what it adds to the sums for AOVs and to the features, in scenes where that may come late.
    std::vector<double> late_aovs;
    std::vector<SampleSet::Features> late_features;
    std::vector<Color> last;          // last sample of each pixel, for StopRule::last_sample
    std::vector<uint8_t> has_missed;  // for each slot whether its camera ray hit nothing; of Film::hides_background
    std::vector<RadianceSum> layers;  // of each slot its layers, if Film::layers has any
    std::vector<float> times;         // of slots: Ray::time; empty where nothing moves
    std::vector<float> flights;       // of states: where a medium scatters them, if some medium does
    PathTrails trails;                // of states, if the listener follows them
    AlphaSamples alpha;               // of slots, if the film has AovSum::through or caught
    bool is_pilot = false;            // the samples are those of a pilot, with other random numbers

    // All rays of a sample are of one time, that of its camera ray. Those in the queue get it.
    void set_times_of_shadows()
    {
        if (times.empty()) [[likely]]
            return;
        for (size_t i = 0; i < queue.shadow_rays.size(); ++i)
            queue.shadow_rays[i].time = times[queue.shadows[i].ends.slot];
        for (Queue::TintedShadow& s : queue.tinted_shadows) s.ray.time = times[s.ends.slot];
        for (Queue::MirroredShadow& s : queue.mirrored_shadows) s.ray.time = times[s.ends.slot];
    }
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
    // After the integrator's turn at a vertex, or behind a surface that it was not called for. The queue held that much
    // before.
    template <class V, class Integrator>
    void left(const V&, const Integrator&, const PathState&, const Surface&, const Sampler&, const QueueSizes&) const
    {
    }
    // A medium scatters the path at t on its ray, which would have met the surface, or none. Instead of vertex().
    void scattered(const PathState&, float, const Medium&, const Surface*) const {}
    // After the integrator's turn in a medium that scatters, whether the path was scattered or not.
    void left_medium(const PathState&, const QueueSizes&) const {}
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
