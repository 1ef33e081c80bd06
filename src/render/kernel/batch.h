// The scalar kernel's loop over rays. A batch of paths of one tile advances in lockstep: their rays are traced
// together, the integrator handles each hit, its shadow rays are traced together, and its next rays form the next
// batch. Each sample has its own accumulator, so that neither batch size nor neighbouring samples change a bit.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>

#include "integrators/media.h"
#include "integrators/path/path.h"
#include "integrators/view.h"
#include "render/kernel/flights.h"
#include "render/kernel/mirrored_shadows.h"
#include "render/kernel/tinted_shadows.h"
#include "render/workspace.h"

namespace lancer {

// Batch size. Integrators with several rays per vertex start with fewer paths, as their batches grow.
template <class Integrator>
uint32_t batch_of(const KernelSettings& settings)
{
    if constexpr (requires { Integrator::branches; })
        return std::min(settings.batch, 16u);
    else
        return settings.batch;
}

// Number of surfaces and random numbers that are computed before the first is used: they are independent, so that the
// processor overlaps them.
inline constexpr size_t lookahead = 32;

// For emplace(): constructs the result of f() in place. Copying a Surface that was just written in parts would stall on
// store forwarding.
template <class F>
struct InPlace {
    const F& f;
    operator std::invoke_result_t<F>() const { return f(); }
};
template <class F>
InPlace(const F&) -> InPlace<F>;

// Film position of a sample in pixels. offset: from the centre of its pixel.
inline Vec2 on_film(const SampleId& id, Vec2 offset)
{
    return {static_cast<float>(id.x) + 0.5f + offset.x, static_cast<float>(id.y) + 0.5f + offset.y};
}
// The camera ray of a sample. The benchmarks specialise it for other views.
template <class V>
Ray camera_ray(const V& view, const Camera& camera, const Filter& filter, const SampleId& id, const Sampler& numbers)
{
    const float time = camera.is_still() && !view.scene.geometry.motion.moves() ? 0 : numbers.get1(0, Dim::time);
    Ray ray = camera.ray(on_film(id, filter.sample(numbers.get2(0, Dim::pixel))), numbers.get2(0, Dim::lens), time);
    ray.time = time;
    return ray;
}

// Traces the samples in w.slots to their end and sums their radiance into w.queue.radiance.
template <class V, class Integrator, class Listener>
void trace_batch(const V& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                 const KernelSettings& settings, const Integrator& integrator, Workspace& w, Counters& counters,
                 const Listener& listener)
{
    const uint32_t samples_per_path = view.plan.samples_per_path();
    const auto sampler = [&](uint32_t slot, uint32_t sample, uint32_t branch) {
        const SampleId& id = w.slots[slot];
        const uint64_t seed = w.seed_of(settings, id.sample / samples_per_path);
        return Sampler(settings.sampler, seed, uint64_t{id.y} * width + id.x, sample, branch);
    };
    w.queue.radiance.assign(w.slots.size(), RadianceSum{});
    // Integrators request at most one ray of each kind per part of a path. Reserving that much avoids allocations in
    // later batches.
    const size_t most = w.slots.size() * view.plan.split;
    w.queue.next.reserve(most);
    w.queue.shadow_rays.reserve(most);
    w.queue.shadows.reserve(most);
    w.occluded.reserve(most);
    w.states.clear();
    w.times.clear();
    const bool moves = view.scene.geometry.motion.moves();
    std::array<std::optional<Sampler>, lookahead> samplers;
    const auto prepare_camera = [&](uint32_t first) {
        SampleRequests<lookahead> requests(Dim::pixel);
        for (uint32_t i = first; i < std::min(w.slots.size(), first + lookahead); ++i)
            requests.add(
                samplers[i - first].emplace(sampler(i, settings.sample_of(w.slots[i].sample / samples_per_path), 0)),
                0);
        requests.prepare();
    };
    for (uint32_t i = 0; i < w.slots.size(); ++i) {
        if (i % lookahead == 0) prepare_camera(i);
        PathState& s = w.states.emplace_back();
        s.slot = i;
        s.sample = settings.sample_of(w.slots[i].sample / samples_per_path);
        s.part = static_cast<uint16_t>(w.slots[i].sample % samples_per_path);
        s.importance = view.plan.importance_at(w.slots[i].x, w.slots[i].y);
        const Sampler& numbers = *samplers[i % lookahead];
        s.ray = camera_ray(view, camera, settings.filter, w.slots[i], numbers);
        if (moves) w.times.push_back(s.ray.time);
        view.set_alpha_key(s.ray, numbers, 0, Dim::alpha);
        s.cone = camera.cone();
        s.media = view.scene.camera_media;
    }
    counters.camera_rays += w.slots.size();

    std::array<std::optional<Surface>, lookahead> surfaces;
    std::array<TriangleInteraction, lookahead> interactions;
    const auto prepare_hits = [&](size_t first) {
        const size_t end = std::min(w.states.size(), first + lookahead);
        SampleRequests<lookahead> requests(Dim::light);  // the group that integrators use first
        view.triangle_interactions(std::span(w.rays).subspan(first, end - first),
                                   std::span(w.hits).subspan(first, end - first), interactions);
        for (size_t i = first; i < end; ++i) {
            if (!w.hits[i]) continue;
            const PathState& s = w.states[i];
            requests.add(samplers[i - first].emplace(sampler(s.slot, s.sample, s.branch)), s.depth);
            surfaces[i - first].emplace(
                InPlace{[&] { return view.surface_at(s.ray, w.hits[i], s.cone, interactions[i - first]); }});
        }
        requests.prepare();
    };
    constexpr bool by_mirrors = std::is_same_v<Integrator, Path>;
    const bool has_mirrors = by_mirrors && !view.scene.mirrors.empty();
    constexpr bool flies = Flies<Integrator>;
    const bool has_media = view.has_media(), scatters = flies && has_media && view.scene.scatters;
    const bool tables_exceed_caches = lancer::tables_exceed_caches(view.scene);
    MediaAtHit media;
    for (Coherence coherence = Coherence::coherent; !w.states.empty(); coherence = Coherence::incoherent) {
        if (moves) [[unlikely]]
            for (PathState& s : w.states) s.ray.time = w.times[s.slot];
        w.rays.clear();
        for (const PathState& s : w.states) w.rays.push_back(s.ray);
        w.hits.resize(w.rays.size());
        if (scatters) [[unlikely]]
            sample_flights(view, sampler, w);
        accel.closest(w.rays, w.hits, coherence);
        if (tables_exceed_caches) prefetch_all(view.scene, w.hits);
        if (coherence == Coherence::incoherent) counters.bounce_rays += w.rays.size();

        w.queue.next.clear();
        w.queue.shadow_rays.clear();
        w.queue.shadows.clear();
        w.queue.tinted_shadows.clear();
        w.queue.mirrored_shadows.clear();
        for (size_t i = 0; i < w.states.size(); ++i) {
            const size_t k = i % lookahead;
            if (k == 0) prepare_hits(i);
            PathState& s = w.states[i];
            PathActions actions(w.queue, s.slot, segment_after(s.segment, false));
            const RadianceSum before = w.queue.radiance[s.slot];
            listener.ray(s, w.hits[i]);
            bool has_flown = false;
            if constexpr (flies)
                if (scatters && !s.last) [[unlikely]] {
                    const Surface* const end = w.hits[i] ? &*surfaces[k] : nullptr;
                    const Flown flown = fly(view, integrator, s, w.flights[i], end, sampler(s.slot, s.sample, s.branch),
                                            w.queue, actions, listener);
                    if (flown == Flown::scattered) continue;
                    has_flown = flown == Flown::to_its_end;
                }
            if (w.hits[i]) {
                if constexpr (by_mirrors)
                    if (has_mirrors) s.mirror = view.scene.mirror_at(w.hits[i]);
                Surface& surface = *surfaces[k];
                if (!has_media || !is_skipped(view.scene, s.media, surface)) listener.vertex(s, surface);
                const QueueSizes queued(w.queue);
                if (!has_media || media.enter(view.scene, s, surface, has_flown, w.queue, actions)) {
                    if (!listener.takes(view, s, surface, *samplers[k]))
                        integrator.hit(view, s, surface, *samplers[k], actions);
                    if (has_media) media.leave(view.scene, surface, w.queue);
                }
                listener.left(view, integrator, s, surface, *samplers[k], queued);
            } else {
                if (has_media && !has_flown) miss_in_media(view.scene, s);
                if (!listener.hides_sky(s)) integrator.miss(view, s, actions);
            }
            listener.added(s, w.hits[i], w.queue.radiance[s.slot].since(before));
        }

        w.set_times_of_shadows();
        w.occluded.resize(w.queue.shadow_rays.size());
        accel.any(w.queue.shadow_rays, w.occluded);
        counters.shadow_rays += w.queue.shadow_rays.size();
        for (size_t i = 0; i < w.occluded.size(); ++i) {
            const Queue::Shadow& shadow = w.queue.shadows[i];
            listener.shadow(shadow.ends, w.queue.shadow_rays[i], shadow.radiance, w.occluded[i]);
            if (!w.occluded[i]) w.queue.radiance[shadow.ends.slot] += shadow.radiance;
        }
        if constexpr (TintsShadows<Integrator>)
            trace_tinted_shadows(view, accel, integrator, w, counters, listener);
        else if constexpr (requires { typename Integrator::TintedShadows; })
            trace_tinted_shadows(view, accel, typename Integrator::TintedShadows{}, w, counters, listener);
        if constexpr (by_mirrors) trace_mirrored_shadows(view, accel, w, counters, listener);
        listener.end_rays(counters);
        std::swap(w.states, w.queue.next);
    }
}

}  // namespace lancer
