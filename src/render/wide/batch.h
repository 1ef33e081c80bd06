// The loop over rays for scenes that are plain enough (scene/wide_scene.h): what trace_batch() does with the path
// integrator, and the same bits of each sample, eight paths at a time.
#pragma once

#include <algorithm>
#include <type_traits>

#include "core/frame.h"
#include "core/warp.h"
#include "integrators/path/path.h"
#include "render/wide/vertices.h"
#include "render/workspace.h"
#include "scene/lights/choice.h"
#include "scene/triangle_place.h"

namespace lancer {

template <Shading shading>
struct WidePath {
    const Path& path;
    const WideScene& scene;

    void miss(const View& view, const State& s, Steps& steps) const { path.miss(view, s, steps); }
};

template <Shading shading>
class WideBatch {
    static constexpr bool looks_up = shading != Shading::plain, any = shading == Shading::any;
    using Vertices = wide::Vertices<shading>;
    using Lanes = typename Vertices::Lanes;
    using Others = wide::Others;
    using LookedUp = wide::LookedUp;
    using Lamps = wide::Lamps;
    using Lit = wide::Lit;
    using Going = wide::Going;
    using Scattered = wide::Scattered;

public:
    WideBatch(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
              const KernelSettings& settings, const WidePath<shading>& integrator, Workspace& w, Counters& counters)
        : view_(view),
          accel_(accel),
          settings_(settings),
          path_(integrator.path),
          scene_(integrator.scene),
          pixel_spread_(camera.pixel_spread()),
          w_(w),
          now_(std::get<PathsUnderWay<Lanes>>(w.wide.paths).now),
          next_(std::get<PathsUnderWay<Lanes>>(w.wide.paths).next),
          shadows_(w.wide.shadows),
          counters_(counters),
          samples_(path_.direct.nee && !view.scene.lights.pick.empty() && (any || !view.lit_by_constant_sky())),
          samples_on_matt_(samples_ && !view.lit_by_constant_sky()),
          samples_sky_(looks_up && samples_ && view.scene.environment_light != Scene::none),
          keeps_normals_(samples_ && (samples_sky_ || view.scene.lights.tree)),
          shines_(std::find(scene_.shines.begin(), scene_.shines.end(), true) != scene_.shines.end()),
          fetches_(has_far_tables(view.scene))
    {
        const size_t most = w.slots.size() * view.plan.split;
        now_.reserve(most), next_.reserve(most), shadows_.reserve(most);
        w.queue.radiance.assign(w.slots.size(), RadianceSum{});
        if (keeps_normals_) w.wide.normals_now.reserve(most), w.wide.normals_next.reserve(most);
        w.hits.reserve(most + float_lanes);
        w.occluded.reserve(most);
        now_.clear();
        for (uint32_t first = 0; first < w.slots.size(); first += float_lanes) send_from(camera, width, first);
        counters.camera_rays += w.slots.size();
    }
    template <class Listener>
    void trace(const Listener& listener)
    {
        for (depth_ = 0; now_.size() > 0; ++depth_) {
            if (depth_ > 0) counters_.bounce_rays += now_.size();
            next_.clear(), shadows_.clear(), w_.wide.normals_next.clear();
            advance(depth_ == 0 ? Coherence::coherent : Coherence::incoherent, listener);
            if (are_last() && !shines_) return;
            add_unoccluded();
            std::swap(now_, next_);
            std::swap(w_.wide.normals_now, w_.wide.normals_next);
        }
    }

private:
    // The rays of now_, to where they end and are shaded.
    template <class Listener>
    void advance(Coherence coherence, const Listener& listener)
    {
        if (are_last() && !shines_) return end_in_sky();
        w_.hits.resize(now_.size() + float_lanes);  // who takes eight need not count
        for (size_t first = 0; first < now_.size(); first += at_once) {
            const size_t n = std::min(at_once, now_.size() - first);
            const std::span<Hit> hits = std::span(w_.hits).subspan(first, n);
            accel_.closest(now_.rays().subspan(first, n), hits, coherence);
            if (fetches_) fetch_shading(view_.scene, hits);
            if constexpr (!std::is_same_v<Listener, NoListener>)
                if (depth_ == 0) tell_of_camera_rays(listener, first, hits);
            shade(first, n);
        }
    }

    // Rays that are traced before the first is shaded: so few that what was looked up for their hits is still near.
    static constexpr size_t at_once = 128;
    void send_from(const Camera& camera, uint32_t width, uint32_t first);
    template <class Listener>
    void tell_of_camera_rays(const Listener& listener, size_t first, std::span<const Hit> hits) const;
    void shade(size_t first, size_t n);
    bool arrive(size_t first, size_t n, Vertices& v);
    EightHits find_materials(Vertices& v) const;
    void find_kinds(std::span<const Hit> hits, Vertices& v) const;
    void find_place(Vertices& v);
    void turn(const PlaceLanes& at, const Vec3x8& wo, Vertices& v);
    void place_drawn(uint32_t drawn, std::span<const Hit> hits, const Vec3x8& wo, Vertices& v);
    static void place_nowhere(Vertices& v);
    void look_up(Vertices& v);
    std::span<const Hit> hits_of(const Vertices& v) const { return std::span(w_.hits).subspan(v.first, v.count); }
    void bend_back(uint32_t lanes, const Vec3x8& wo, Vertices& v);
    void take_fixed(uint32_t lanes, uint32_t front, Vertices& v);
    template <class B>
    void take_own(uint32_t i, const B& bsdf, Vertices& v);
    template <class At>
    void take_each(uint32_t lanes, Vertices& v, const At& at);
    // Where a ray starts that leaves on the other side.
    static Vec3 origin_behind(const Vertices& v, uint32_t i)
    {
        const Vec3 n = lane(v.n, i);
        return offset_origin(lane(v.others.p, i), lane(v.others.p_error, i), n, -n);
    }
    uint32_t asks_for_light(const Vertices& v) const;
    Lamps choose_lamps(const Vertices& v, uint32_t asking, const AddressLanes& address, const Vec2x8& u) const;
    void sample_light(const Vertices& v, const AddressLanes& address, const Vec2x8& u, Lit& lit);
    void add_even_sky(const Vertices& v, const Vec2x8& u, uint32_t lanes, LightSampleLanes& s) const;
    void sample_any_light(const Vertices& v, const Lamps& lamps, Lit& lit);
    void sample_direct(std::span<const Vertices> vertices);
    void ask_for_light(const Vertices& v, Lit& lit);
    void eval_others(const Vertices& v, const Lit& lit, uint32_t lanes, Vec3x8& f_cos, Float8& pdf) const;
    void send_shadows(const Vertices& v, const Lit& lit);
    void scatter(Vertices& v);
    void scatter_any(std::span<Vertices> vertices);
    void begin_going(Vertices& v, Going& g);
    void send_part(std::span<Vertices> vertices, uint32_t part);
    void choose_part(const Vertices& v, Going& g, uint32_t lanes);
    void finish_part(Vertices& v, const Going& g, uint32_t lanes);
    UInt8 of_first_part(const Lanes& path, uint32_t lanes) const;
    uint32_t split_any(uint32_t sends, const Others& others, AnyPathLanes& path) const;
    Scattered sample_any(const Vertices& v, const Going& g, uint32_t lanes) const;
    void send(uint32_t lanes, const Vec3x8& origin, const Vec3x8& wi, const Vertices& v);
    Float8 survival(const Lanes& next) const;
    template <class Of>
    void give_keys(PackedStates<Of>& sent, uint32_t lanes, const PathLanes& path, uint32_t bounce, Dim dim);
    State state_of(size_t i, const Lanes& path, uint32_t lane) const;
    void add_emission(size_t i, const Lanes& path, uint32_t lane);
    void add_sky(uint32_t missed, size_t first, const Lanes& path);
    void add_unoccluded();
    void end_in_sky();
    void spoil(uint32_t lanes, UInt8 slots)
    {
        for_bits(lanes, [&](uint32_t i) { Steps(w_.queue, slots[i]).spoil(); });
    }

    Leg leg() const { return depth_ == 0 ? Leg::view : depth_ == 1 ? Leg::direct : Leg::indirect; }
    static Leg leg_of(UInt8 so_far, uint32_t lane) { return static_cast<Leg>(so_far[lane] >> leg_above); }
    // Whether only emission counts where the rays of this depth end.
    bool are_last() const
    {
        if (depth_ == 0) return false;
        return depth_ == path_.max_depth || (!any && leg() == Leg::direct && !path_.parts.indirect);
    }
    // Lanes of which that is so.
    uint32_t last_of(const Lanes& path) const
    {
        if (are_last()) return 255;
        if constexpr (any)
            if (!path_.parts.indirect) return bits((path.so_far >> leg_above) == static_cast<uint32_t>(Leg::direct));
        return 0;
    }
    AddressLanes numbers(const KeyLanes& key, uint32_t bounce, Dim dim) const
    {
        return {settings_.sampler, key, bounce, dim};
    }

    const View& view_;
    const Accelerator& accel_;
    const KernelSettings& settings_;
    const Path& path_;
    const WideScene& scene_;
    const float pixel_spread_;
    Workspace& w_;
    PackedStates<Lanes>&now_, &next_;
    PackedStates<ShadowLanes>& shadows_;
    Counters& counters_;
    // Lights, at each vertex. Where there is nothing but a constant sky to sample, nothing is.
    bool samples_, samples_on_matt_;
    bool samples_sky_;    // as one of them
    bool keeps_normals_;  // see WideWorkspace
    bool shines_;         // whether any surface does
    bool fetches_;        // has_far_tables()
    uint32_t depth_ = 0;
    // The vertices at work: kept, as to set so much to zero for each eight would take longer than to use some of it. No
    // function reads what none has written for these eight.
    std::array<Vertices, at_once / float_lanes> vertices_;
    // And what is not matt asks for besides.
    struct OthersAtWork {
        PlasticList plastic;
        std::array<Lit, at_once / float_lanes> lit;
        std::array<Going, at_once / float_lanes> going;
    };
    static_assert(at_once <= PlasticList::most);
    [[no_unique_address]] std::conditional_t<any, OthersAtWork, wide::Nothing> others_;
};

template <Shading shading>
inline void WideBatch<shading>::send_from(const Camera& camera, uint32_t width, uint32_t first)
{
    const size_t n = std::min<size_t>(float_lanes, w_.slots.size() - first);
    Lanes path{};
    if constexpr (looks_up) path.spread = all_lanes(pixel_spread_);
    const Float8 one = all_lanes(1.0f);
    if constexpr (any) path.eta_scale = one, path.so_far = UInt8{} + was_specular;
    path.throughput = {one, one, one};
    Vec2x8 film{};
    for (uint32_t i = 0; i < n; ++i) {
        const SampleId& id = w_.slots[first + i];
        const uint32_t number = id.sample / view_.plan.of_path();
        const uint64_t key = Sampler::key_of(w_.seed_of(settings_, number), uint64_t{id.y} * width + id.x, 0);
        const Color worth = view_.plan.worth_at(id.x, id.y);
        path.slot[i] = first + i, path.sample[i] = settings_.sample_of(number);
        path.key.low[i] = static_cast<uint32_t>(key), path.key.high[i] = static_cast<uint32_t>(key >> 32);
        path.worth.x[i] = worth.r, path.worth.y[i] = worth.g, path.worth.z[i] = worth.b;
        film.x[i] = static_cast<float>(id.x) + 0.5f, film.y[i] = static_cast<float>(id.y) + 0.5f;
    }
    const Vec2x8 offset = settings_.filter.sample(numbers(path.key, 0, Dim::pixel).get2(path.sample));
    film.x += offset.x, film.y += offset.y;
    Vec3x8 org = all_lanes(camera.position()), dir;
    if (camera.is_pinhole()) {
        dir = camera.middle_directions(film);
    } else {
        const Vec2x8 lens = numbers(path.key, 0, Dim::lens).get2(path.sample);
        for (uint32_t i = 0; i < n; ++i) {
            const Ray ray = camera.ray({film.x[i], film.y[i]}, {lens.x[i], lens.y[i]});
            set_lane(org, i, ray.org), set_lane(dir, i, ray.dir);
        }
    }
    const uint32_t all = (1u << n) - 1;
    now_.push(all, org, dir, all_lanes(Ray{}.t_max), path);
    now_.say_starts(all, UInt8{} + Ray::nowhere);
    give_keys(now_, all, path, 0, Dim::hole);
}

// What listeners hear of a sample before it is shaded. Ray i is that of slot i.
template <Shading shading>
template <class Listener>
inline void WideBatch<shading>::tell_of_camera_rays(const Listener& listener, size_t first,
                                                    std::span<const Hit> hits) const
{
    State s;
    s.cone = {0, pixel_spread_};
    for (size_t i = 0; i < hits.size(); ++i) {
        s.slot = static_cast<uint32_t>(first + i);
        s.ray = now_.rays()[first + i];
        listener.ray(s, hits[i]);
        if (hits[i]) listener.vertex(s, view_.surface_at(s.ray, hits[i], s.cone));
    }
}

// The vertices of n rays, at most at_once. Each step is done for all of them before the next: the code of one step
// stays in the cache of instructions, that of all of them does not.
template <Shading shading>
inline void WideBatch<shading>::shade(size_t first, size_t n)
{
    if constexpr (any) others_.plastic.clear();
    size_t met = 0;
    for (size_t i = 0; i < n; i += float_lanes)
        if (arrive(first + i, std::min<size_t>(float_lanes, n - i), vertices_[met])) ++met;
    const std::span vertices = std::span(vertices_).first(met);
    if constexpr (looks_up) {
        for (Vertices& v : vertices) find_place(v);
        for (Vertices& v : vertices) look_up(v);
    }
    if constexpr (any) others_.plastic.see();
    if (samples_) sample_direct(vertices);
    if constexpr (any)
        scatter_any(vertices);
    else
        for (Vertices& v : vertices) scatter(v);
}

// To those of the lanes that were just sent. See View::give_key().
template <Shading shading>
template <class Of>
inline void WideBatch<shading>::give_keys(PackedStates<Of>& sent, uint32_t lanes, const PathLanes& path,
                                          uint32_t bounce, Dim dim)
{
    if constexpr (!looks_up) return;
    if (!view_.scene.geometry.holes.let_pass) return;
    const AddressLanes address = numbers(path.key, bounce, dim);
    Ray* ray = sent.last_rays(static_cast<size_t>(std::popcount(lanes))).data();
    for_bits(lanes, [&](uint32_t i) { (ray++)->key = address.key(i, path.sample[i]); });
}

// See render/kernel/batch.h. The listener hears of what camera rays meet alone.
template <Shading shading, class Listener>
inline void trace_batch(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                        const KernelSettings& settings, const WidePath<shading>& integrator, Workspace& w,
                        Counters& counters, const Listener& listener)
{
    WideBatch<shading>(view, accel, camera, width, settings, integrator, w, counters).trace(listener);
}

}  // namespace lancer
