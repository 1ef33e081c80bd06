// The kernel of a tile: which samples are traced, in what order, and how they are summed. Only render/kernel/NAME.cpp
// include it, each for one integrator, so that they compile in parallel; a benchmark includes it with other views (V).
#pragma once

#include <algorithm>
#include <limits>

#include "render/aov.h"
#include "render/blocks.h"
#include "render/kernel/batch.h"
#include "render/kernel/kernels.h"
#include "render/light_layers.h"

namespace lancer {

// The radiance that is added to the film for a sample.
inline Color film_radiance(Color radiance, const KernelSettings& settings)
{
    if (!settings.clamp) return radiance;
    const auto clamp = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
    return {clamp(radiance.r), clamp(radiance.g), clamp(radiance.b)};
}

// Radiance of a camera ray that hits nothing, in a scene where it is constant.
template <class V, class Integrator>
Color background_only_radiance(const V& view, const Integrator& integrator, Workspace& w)
{
    w.queue.radiance.assign(1, RadianceSum{});
    PathActions actions(w.queue, 0);
    PathState s;
    s.ray.dir = {0, 0, 1};
    integrator.miss(view, s, actions);
    return w.queue.radiance[0].color();
}

// Sums samples [begin, end) of every pixel of a tile into w.block; with adaptive sampling, fewer where a pixel needs
// fewer.
template <class V, class Integrator, class Listener>
void trace_samples(const V& view, const Accelerator& accel, const Camera& camera, const KernelSettings& settings,
                   const Integrator& integrator, Film& film, Tile tile, SampleRange samples, Workspace& w,
                   Counters& counters, const Listener& listener)
{
    const auto index = [&](const SampleId& id) { return size_t{id.y - tile.y0} * tile.width() + (id.x - tile.x0); };
    // layers: those of the sample; null: it is black in all, or there are none.
    const auto count = [&](const SampleId& id, Color c, const RadianceSum* layers) {
        if (!is_finite(c)) return counters.drop(id);
        Pixel& p = w.block[index(id)];
        const double y = luminance(c);
        p += {{c.r, c.g, c.b}, y * y, 1};
        if (!w.last.empty()) w.last[index(id)] = c;
        if ((film.replicates.empty() && film.sets.empty() && film.layer_sums.empty()) || w.is_pilot) return;
        const auto add_to = [c](auto& r) {
            r.sum[0] += double{c.r}, r.sum[1] += double{c.g}, r.sum[2] += double{c.b}, ++r.n;
        };
        const uint32_t path = id.sample / view.plan.samples_per_path();
        if (!film.replicates.empty())
            add_to(film.replicates[film.index(id.x, id.y) * settings.replicates + settings.replicate_of(path)]);
        if (!film.sets.empty()) add_to(film.set_of(film.index(id.x, id.y), path));
        if (!layers) return;
        std::array<double, 3>* const sums =
            film.layers_of(film.index(id.x, id.y), film.sets.empty() ? 0 : film.deal.set_of(path));
        for (uint32_t k = 0; k < film.layers.size(); ++k)
            sums[k][0] += layers[k].r, sums[k][1] += layers[k].g, sums[k][2] += layers[k].b;
    };
    const auto flush = [&] {
        if (film.hides_background) w.has_missed.assign(w.slots.size(), 0);
        w.layers.assign(w.slots.size() * film.layers.size(), RadianceSum{});
        listener.begin_samples();
        trace_batch(view, accel, camera, film.width, settings, integrator, w, counters, listener);
        listener.end_samples();
        for (size_t i = 0; i < w.slots.size(); ++i) {
            const bool is_hidden = film.hides_background && w.has_missed[i];
            count(w.slots[i], is_hidden ? Color{} : film_radiance(w.queue.radiance[i].color(), settings),
                  is_hidden || w.layers.empty() ? nullptr : &w.layers[i * film.layers.size()]);
        }
        w.slots.clear();
    };
    const auto end_of = [&](uint32_t x, uint32_t y) {
        if (film.wanted.empty() || w.is_pilot) return samples.end;
        const uint32_t wanted = film.wanted[film.index(x, y)];
        return wanted == 0 ? samples.end : std::min(samples.end, wanted);
    };
    // Radiance of the pixels that the plan marks as background only.
    const Color sky = view.plan.background_only.empty() || film.hides_background
                          ? Color{}
                          : film_radiance(background_only_radiance(view, integrator, w), settings);
    std::vector<RadianceSum> sky_layers;
    if (film.layers.size() > 0 && !film.hides_background)
        sky_layers = layers_of_sky(view.scene.light_groups, film.layers, sky);
    const auto count_background_only = [&](uint32_t x, uint32_t y) {
        for (uint32_t i = samples.begin, end = end_of(x, y); i < end; ++i, ++counters.background_only_samples) {
            count({x, y, i}, sky, sky_layers.empty() ? nullptr : sky_layers.data());
            listener.background_only({x, y, i});
        }
    };
    const uint32_t batch = batch_of<Integrator>(settings);
    const auto send = [&](const SampleId& id) {
        w.slots.push_back(id);
        if (w.slots.size() == batch) flush();
    };
    constexpr uint32_t square = 4;  // pixels are visited in small squares, so that the rays of a packet are close
    w.slots.clear();
    w.slots.reserve(batch);
    for (uint32_t y0 = tile.y0; y0 < tile.y1; y0 += square)
        for (uint32_t x0 = tile.x0; x0 < tile.x1; x0 += square)
            for (uint32_t y = y0; y < std::min(tile.y1, y0 + square); ++y)
                for (uint32_t x = x0; x < std::min(tile.x1, x0 + square); ++x) {
                    if (view.plan.is_background_only(x, y)) {
                        count_background_only(x, y);
                        continue;
                    }
                    for (uint32_t i = samples.begin, end = end_of(x, y); i < end; ++i) send({x, y, i});
                }
    flush();
}

// Adaptive sampling: renders the pilot samples of a tile and computes the number of samples of each pixel. Runs once,
// with the first samples.
template <class V, class Integrator>
void trace_pilots(const V& view, const Accelerator& accel, const Camera& camera, const KernelSettings& settings,
                  const Integrator& integrator, Film& film, Tile tile, Workspace& w, Counters& counters)
{
    if (film.wanted[film.index(tile.x0, tile.y0)] != 0) return;
    w.is_pilot = true;
    w.block.assign(size_t{tile.width()} * tile.height(), Pixel{});
    Counters own;
    trace_samples(view, accel, camera, settings, integrator, film, tile, {0, samples_per_block}, w, own, NoListener{});
    w.is_pilot = false;
    // Only dropped samples of the picture are counted.
    own.dropped = 0;
    own.first_dropped.reset();
    counters += own;
    for (uint32_t y = tile.y0; y < tile.y1; ++y)
        for (uint32_t x = tile.x0; x < tile.x1; ++x)
            film.wanted[film.index(x, y)] =
                samples_for(w.block[size_t{y - tile.y0} * tile.width() + (x - tile.x0)], settings.stop_error);
}

// As trace_samples(), and tests after each sample whether the pixel ends.
template <class V, class Integrator, class Listener>
void trace_one_by_one(const V& view, const Accelerator& accel, const Camera& camera, const KernelSettings& settings,
                      const Integrator& integrator, Film& film, Tile tile, SampleRange samples, Workspace& w,
                      Counters& counters, const Listener& listener)
{
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    for (uint32_t i = samples.begin; i < samples.end; ++i) {
        w.last.assign(w.block.size(), {none, none, none});
        trace_samples(view, accel, camera, settings, integrator, film, tile, {i, i + 1}, w, counters, listener);
        for (uint32_t y = tile.y0; y < tile.y1; ++y)
            for (uint32_t x = tile.x0; x < tile.x1; ++x) {
                const size_t k = size_t{y - tile.y0} * tile.width() + (x - tile.x0);
                Pixel so_far = film.at(x, y);
                so_far += w.block[k];
                if (ends_with(so_far, w.last[k])) film.wanted[film.index(x, y)] = i + 1;
            }
    }
    w.last.clear();
}

// Before sample `first`, of those pixels of a tile that will have it.
inline void begin_intervals(Film& film, const Tile& tile, uint32_t first)
{
    for_pixels(film, tile, [&](size_t i, size_t) {
        if (film.wanted.empty() || film.wanted[i] == 0 || film.wanted[i] > first) film.begin_interval(i);
    });
}

// Renders samples [begin, end) of every pixel of a tile into the film.
template <class V, class Integrator, class Listener>
void render_tile(const V& view, const Accelerator& accel, const Camera& camera, const KernelSettings& settings,
                 const Integrator& integrator, Film& film, Tile tile, SampleRange samples, Workspace& w,
                 Counters& counters, const Listener& listener)
{
    const StopRule stop = film.wanted.empty() ? StopRule::never : settings.stop;
    if (stop == StopRule::confidence) trace_pilots(view, accel, camera, settings, integrator, film, tile, w, counters);
    Blocks blocks{film.pixels, film.open};
    const bool has_intervals = !film.sets.empty() && film.deal.has_intervals();
    for (uint32_t first = samples.begin; first < samples.end;) {
        uint32_t last = first + std::min(samples.end - first, samples_per_block - first % samples_per_block);
        if (has_intervals) {
            last = std::min(last, SetDeal::next_begin(first));
            if (SetDeal::is_begin(first)) begin_intervals(film, tile, first);
        }
        w.block.resize(size_t{tile.width()} * tile.height());
        for_pixels(film, tile, [&](size_t i, size_t k) { w.block[k] = blocks.take(i, first); });
        listener.begin_block(first);
        const auto trace = [&](const auto& how) {
            how(view, accel, camera, settings, integrator, film, tile, SampleRange{first, last}, w, counters, listener);
        };
        if (stop == StopRule::last_sample)
            trace(trace_one_by_one<V, Integrator, Listener>);
        else
            trace(trace_samples<V, Integrator, Listener>);
        for_pixels(film, tile, [&](size_t i, size_t k) { blocks.put(i, w.block[k], last); });
        listener.end_block(last);
        first = last;
    }
}

// Calls render(listener) with the listener that fills the film's AOVs and features, if it has any.
template <class Render>
void for_listener(const Scene& scene, const Accelerator& accel, const Camera& camera, Film& film, const Tile& tile,
                  Workspace& w, const Render& render)
{
    if (film.aovs.empty() && film.sets.empty() && film.layer_sums.empty() && film.mattes.empty())
        return render(NoListener{});
    render(AovListener(scene, accel, camera.axis(), film, tile, w));
}

template <class Integrator>
void Kernels<Integrator>::render(const View& view, const Accelerator& accel, const Camera& camera,
                                 const KernelSettings& settings, const Integrator& integrator, Film& film, Tile tile,
                                 SampleRange samples, Workspace& w, Counters& counters)
{
    for_listener(view.scene, accel, camera, film, tile, w, [&](const auto& listener) {
        render_tile(view, accel, camera, settings, integrator, film, tile, samples, w, counters, listener);
    });
}

template <class Integrator>
template <class Listener>
void Kernels<Integrator>::trace(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                                const KernelSettings& settings, const Integrator& integrator, Workspace& w,
                                Counters& counters, const Listener& listener)
{
    trace_batch(view, accel, camera, width, settings, integrator, w, counters, listener);
}

// Forwards the events of the only sample of a batch to a PathListener.
struct ReplayListener : NoListener {
    const PathListener& listener;

    void ray(const PathState& s, const Hit& hit) const { listener.ray(s, hit); }
    void vertex(const PathState& s, const Surface& at) const { listener.vertex(s, at); }
    void added(const PathState& s, const Hit&, Color c) const { listener.added(s, c); }
    void scattered(const PathState& s, float t, const Medium&, const Surface*) const { listener.scattered(s, t); }
    void shadow(const ShadowEnds&, const Ray& ray, Color c, bool occluded) const { listener.shadow(ray, c, occluded); }
    void mirrored_shadow(const ShadowEnds&, const Ray& ray, Color c, bool occluded) const
    {
        listener.mirrored_shadow(ray, c, occluded);
    }
};

template <class Integrator>
Color Kernels<Integrator>::replay(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                                  const KernelSettings& settings, const Integrator& integrator, const SampleId& id,
                                  const PathListener& listener)
{
    Workspace w;
    Counters counters;
    w.slots.push_back(id);
    trace_batch(view, accel, camera, width, settings, integrator, w, counters, ReplayListener{{}, listener});
    return film_radiance(w.queue.radiance[0].color(), settings);
}

}  // namespace lancer
