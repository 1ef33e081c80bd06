// The wide kernel's loop over rays, for scenes that WideScene supports: trace_batch() with the path integrator for
// eight paths at a time, with the same bits for each sample.
#pragma once

#include <algorithm>
#include <optional>
#include <type_traits>

#include "core/frame.h"
#include "core/warp.h"
#include "integrators/path/path.h"
#include "render/estimators/arrivals.h"
#include "render/kernel/mirrored_shadows.h"
#include "render/kernel/tinted_shadows.h"
#include "render/wide/vertices.h"
#include "render/workspace.h"
#include "scene/lights/choice.h"
#include "scene/triangle_interaction.h"

namespace lancer {

template <Shading shading>
struct WidePath {
    const Path& path;
    const WideScene& scene;

    void miss(const View& view, const PathState& s, PathActions& actions) const { path.miss(view, s, actions); }
};

template <Shading shading>
class WideBatch {
    static constexpr bool textured = shading != Shading::plain, any = shading == Shading::any;
    using Vertices = wide::Vertices<shading>;
    using Lanes = typename Vertices::Lanes;
    using NonLambert = wide::NonLambert;
    using SurfaceQuery = wide::SurfaceQuery;
    using ChosenLights = wide::ChosenLights;
    using LightQuery = wide::LightQuery;
    using ScatterState = wide::ScatterState;
    using BsdfSamples = wide::BsdfSamples;

public:
    WideBatch(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
              const KernelSettings& settings, const WidePath<shading>& integrator, Workspace& w, Counters& counters)
        : view_(view),
          accel_(accel),
          settings_(settings),
          path_(integrator.path),
          scene_(integrator.scene),
          camera_cone_(camera.cone()),
          w_(w),
          now_(std::get<PathsUnderWay<Lanes>>(w.wide.paths).now),
          next_(std::get<PathsUnderWay<Lanes>>(w.wide.paths).next),
          shadows_(w.wide.shadows),
          queues_(w.queues),
          counters_(counters),
          samples_(path_.direct.nee && !view.scene.lights.pick.empty() && (any || !view.leaves_sky_to_cosine())),
          samples_on_matt_(samples_ && !view.leaves_sky_to_cosine()),
          learned_(samples_ && !view.plan.light_choice.empty()),
          keeps_cells_(learned_ && view.plan.light_choice.chooses()),
          tiles_(textured && samples_ && view.plan.light_choice.has_tiles),
          samples_sky_(textured && samples_ && (tiles_ || view.scene.environment_light != Scene::none)),
          by_mirrors_(any && samples_ && path_.direct.mirrors && !view.scene.mirrors.empty()),
          keeps_normals_(samples_ && (samples_sky_ || view.scene.lights.tree)),
          shines_(std::find(scene_.shines.begin(), scene_.shines.end(), true) != scene_.shines.end()),
          prefetches_(tables_exceed_caches(view.scene)),
          moves_(textured && view.scene.geometry.motion.moves())
    {
        if constexpr (any) {
            queues_.template need<PlasticQueue>(true);
            queues_.template need<PrincipledQueue>(scene_.has_principled);
            queues_.template need<GlassQueue>(scene_.has_rough_glass);
            queues_.template need<MetalQueue>(scene_.has_rough_metal);
        }
        const size_t most = w.slots.size() * view.plan.split;
        now_.reserve(most), next_.reserve(most), shadows_.reserve(most);
        w.queue.radiance.assign(w.slots.size(), RadianceSum{});
        if (keeps_normals_) w.wide.normals_now.reserve(most), w.wide.normals_next.reserve(most);
        if (keeps_cells_) w.wide.cells_now.reserve(most), w.wide.cells_next.reserve(most);
        if (by_mirrors_) w.wide.mirror_distances_now.reserve(most), w.wide.mirror_distances_next.reserve(most);
        w.hits.reserve(most + float_lanes);
        w.occluded.reserve(most);
        now_.clear();
        w.times.assign(moves_ ? w.slots.size() : 0, 0);
        for (uint32_t first = 0; first < w.slots.size(); first += float_lanes)
            generate_camera_rays(camera, width, first);
        counters.camera_rays += w.slots.size();
    }
    template <class Listener>
    void trace(const Listener& listener)
    {
        if constexpr (std::is_same_v<Listener, ArrivalListener>)
            if (listener.listens()) {
                arrivals_ = &listener;
                w_.wide.shadow_lights.reserve(w_.slots.size() * view_.plan.split);
            }
        for (depth_ = 0; now_.size() > 0; ++depth_) {
            if (depth_ > 0) counters_.bounce_rays += now_.size();
            next_.clear(), shadows_.clear(), w_.wide.normals_next.clear(), w_.wide.cells_next.clear();
            w_.wide.shadow_lights.clear(), w_.wide.mirror_distances_next.clear();
            advance(depth_ == 0 ? Coherence::coherent : Coherence::incoherent, listener);
            if (are_last() && !shines_) return;
            add_unoccluded();
            if constexpr (any) {
                if (view_.scene.passes_glass || by_mirrors_) w_.set_times_of_shadows();
                if (view_.scene.passes_glass) {
                    const auto trace = [&](const auto& to) {
                        trace_tinted_shadows(view_, accel_, Path::TintedShadows{}, w_, counters_, to);
                    };
                    arrivals_ ? trace(*arrivals_) : trace(NoListener{});
                }
                if (by_mirrors_) {
                    trace_mirrored_shadows(view_, accel_, w_, counters_, NoListener{});
                    w_.queue.mirrored_shadows.clear();
                    std::swap(w_.wide.mirror_distances_now, w_.wide.mirror_distances_next);
                }
            }
            std::swap(now_, next_);
            std::swap(w_.wide.normals_now, w_.wide.normals_next);
            std::swap(w_.wide.cells_now, w_.wide.cells_next);
        }
    }

private:
    // Traces the rays of now_ and shades their hits.
    template <class Listener>
    void advance(Coherence coherence, const Listener& listener)
    {
        set_times(now_);
        if (are_last() && !shines_) return end_at_background();
        w_.hits.resize(now_.size() + float_lanes);  // padding, so that eight hits can always be read
        for (size_t first = 0; first < now_.size(); first += at_once) {
            const size_t n = std::min(at_once, now_.size() - first);
            const std::span<Hit> hits = std::span(w_.hits).subspan(first, n);
            accel_.closest(now_.rays().subspan(first, n), hits, coherence);
            if (prefetches_) prefetch_shading(view_.scene, hits);
            if constexpr (!std::is_same_v<Listener, NoListener> && !std::is_same_v<Listener, ArrivalListener>)
                if (depth_ == 0) report_camera_hits(listener, first, hits);
            shade(first, n);
        }
    }

    // Rays are of the time of their sample, where something moves.
    template <class States>
    void set_times(States& rays)
    {
        if constexpr (textured) {
            if (!moves_) [[likely]]
                return;
            const std::span<Ray> all = rays.last_rays(rays.size());
            typename States::Record lanes;
            for (size_t first = 0; first < all.size(); first += float_lanes) {
                rays.load(first, lanes);
                for (size_t i = 0; i < std::min<size_t>(float_lanes, all.size() - first); ++i)
                    all[first + i].time = w_.times[slot_of(lanes)[i]];
            }
        }
    }
    static UInt8 slot_of(const Lanes& path) { return path.slot; }
    static UInt8 slot_of(const ShadowLanes& shadow) { return shadow.slot; }

    // Number of rays that are traced before their hits are shaded: few enough that the cache still holds the data of
    // their hits.
    static constexpr size_t at_once = 128;
    void generate_camera_rays(const Camera& camera, uint32_t width, uint32_t first);
    template <class Listener>
    void report_camera_hits(const Listener& listener, size_t first, std::span<const Hit> hits) const;
    void shade(size_t first, size_t n);
    bool find_vertices(size_t first, size_t n, Vertices& v);
    HitIndices find_materials(Vertices& v) const;
    void classify_surfaces(std::span<const Hit> hits, Vertices& v) const;
    void find_surfaces(Vertices& v);
    void set_surface(const InteractionLanes& at, const Vec3x8& wo, Vertices& v);
    void set_triangle_surfaces(uint32_t drawn, std::span<const Hit> hits, const Vec3x8& wo, Vertices& v);
    static void clear_surfaces(Vertices& v);
    void lookup_materials(Vertices& v);
    std::span<const Hit> hits_of(const Vertices& v) const { return std::span(w_.hits).subspan(v.first, v.count); }
    void keep_reflections_outside(uint32_t lanes, const Vec3x8& wo, Vertices& v);
    void lookup_bsdf(uint32_t lanes, uint32_t front, Vertices& v);
    template <class B>
    void lookup_bsdf(uint32_t i, const B& bsdf, Vertices& v);
    static void add_flags(uint32_t i, uint32_t of_bsdf, NonLambert& non_lambert);
    void lookup_turned(uint32_t i, Vec2 tangent, bool front, Vertices& v);
    // Whether the mesh colours the point.
    bool is_coloured(const Hit& hit) const
    {
        return scene_.has_colors && hit.kind == Kind::triangle && !view_.scene.shading[hit.geometry].colors.empty();
    }
    bool only_turns(const Hit& hit, uint32_t material) const
    {
        return scene_.fixed[material].turns && !is_coloured(hit);
    }
    template <class At>
    void lookup_bsdf(uint32_t lanes, Vertices& v, const At& at);
    static void see_principled(NonLambert& non_lambert);
    template <class F>
    static auto with_bsdf(const NonLambert& non_lambert, uint32_t lane, const F& f);
    // Origin of a ray that leaves on the other side of the surface.
    static Vec3 origin_behind(const Vertices& v, uint32_t i)
    {
        const Vec3 n = lane(v.n, i);
        return offset_origin(lane(v.non_lambert.p, i), lane(v.non_lambert.p_error, i), n, -n);
    }
    uint32_t light_sampling_lanes(const Vertices& v) const;
    uint32_t shown_lanes(const Vertices& v) const;
    void sample_mirrored(Vertices& v);
    void follow_mirrors(Vertices& v);
    ChosenLights choose_lights(const Vertices& v, const LightQuery& query, const AddressLanes& address,
                               const Vec2x8& u) const;
    void sample_light(const Vertices& v, const AddressLanes& address, const Vec2x8& u, LightQuery& query);
    void sample_constant_environment(const Vertices& v, const ChosenLights& chosen, uint32_t lanes,
                                     LightSampleLanes& s) const;
    void sample_any_light(const Vertices& v, const ChosenLights& chosen, LightQuery& query);
    void sample_direct(std::span<Vertices> vertices);
    uint32_t lanes_by_rate(uint32_t lanes, Vertices& v) const;
    void query_light(Vertices& v, LightQuery& query);
    void eval_non_lambert(const Vertices& v, const LightQuery& query, uint32_t lanes, Vec3x8& f_cos, Float8& pdf) const;
    void send_through_glass(const Vertices& v, uint32_t lanes, const LightQuery& query, const Vec3x8& origin,
                            const Vec3x8& dir, const Float8& distance, const Vec3x8& radiance);
    void send_shadows(const Vertices& v, const LightQuery& query);
    void scatter(Vertices& v);
    void scatter_any(std::span<Vertices> vertices);
    void begin_scatter(Vertices& v, ScatterState& g);
    void send_part(std::span<Vertices> vertices, uint32_t part);
    void choose_part(const Vertices& v, ScatterState& g, uint32_t lanes);
    void finish_part(Vertices& v, const ScatterState& g, uint32_t lanes);
    UInt8 of_first_part(const Lanes& path, uint32_t lanes) const;
    uint32_t split_any(uint32_t sends, const NonLambert& non_lambert, AnyPathLanes& path) const;
    BsdfSamples sample_any(const Vertices& v, const ScatterState& g, uint32_t lanes) const;
    void send(uint32_t lanes, const Vec3x8& origin, const Vec3x8& wi, const Vertices& v);
    Float8 survival(const Lanes& next) const;
    template <class Of>
    void set_alpha_keys(PackedStates<Of>& sent, uint32_t lanes, const PathLanes& path, uint32_t bounce, Dim dim);
    PathState state_of(size_t i, const Lanes& path, uint32_t lane) const;
    void add_emission(size_t i, const Lanes& path, uint32_t lane);
    void add_background(uint32_t missed, size_t first, const Lanes& path);
    void add_unoccluded();
    void end_at_background();
    void invalidate(uint32_t lanes, UInt8 slots)
    {
        for_each_lane(lanes, [&](uint32_t i) { PathActions(w_.queue, slots[i]).invalidate(); });
    }

    PathSegment segment() const
    {
        return depth_ == 0 ? PathSegment::view : depth_ == 1 ? PathSegment::direct : PathSegment::indirect;
    }
    static PathSegment segment_of(UInt8 path_flags, uint32_t lane)
    {
        return static_cast<PathSegment>(path_flags[lane] >> segment_shift);
    }
    // Whether only emission counts at the end of the rays of this depth.
    bool are_last() const
    {
        if (depth_ == 0) return false;
        return depth_ == path_.max_depth || (!any && segment() == PathSegment::direct && !path_.parts.indirect);
    }
    // Lanes for which that is true.
    uint32_t last_of(const Lanes& path) const
    {
        if (are_last()) return 255;
        if constexpr (any)
            if (!path_.parts.indirect)
                return movemask((path.path_flags >> segment_shift) == static_cast<uint32_t>(PathSegment::direct));
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
    const RayCone camera_cone_;
    Workspace& w_;
    PackedStates<Lanes>&now_, &next_;
    PackedStates<ShadowLanes>& shadows_;
    MaterialQueues& queues_;
    Counters& counters_;
    // Whether light sampling is done, for all and for Lambertian surfaces.
    bool samples_, samples_on_matt_;
    bool learned_;                               // there is a LightChoice
    bool keeps_cells_;                           // see WideWorkspace
    bool tiles_;                                 // LightChoice chooses tiles of the sky
    bool samples_sky_;                           // the environment is one of the lights, as a whole or in tiles
    bool by_mirrors_;                            // light is sampled by way of mirrors
    bool keeps_normals_;                         // see WideWorkspace
    bool shines_;                                // whether any surface emits
    bool prefetches_;                            // tables_exceed_caches()
    bool moves_;                                 // something does, while the shutter is open
    const ArrivalListener* arrivals_ = nullptr;  // of a pilot that learns
    uint32_t depth_ = 0;
    // The vertices in work. They are members because clearing them for each group of eight would take longer than using
    // them; no function reads what was not written for the present group.
    std::array<Vertices, at_once / float_lanes> vertices_;
    // Additional working memory for materials that are not Lambertian.
    struct NonLambertWorkspace {
        std::array<LightQuery, at_once / float_lanes> query;
        std::array<ScatterState, at_once / float_lanes> scatter_state;
    };
    static_assert(at_once <= LaneQueue::most);
    [[no_unique_address]] std::conditional_t<any, NonLambertWorkspace, wide::Empty> non_lambert_;
};

template <Shading shading>
inline void WideBatch<shading>::generate_camera_rays(const Camera& camera, uint32_t width, uint32_t first)
{
    const size_t n = std::min<size_t>(float_lanes, w_.slots.size() - first);
    Lanes path{};
    if constexpr (textured) path.spread = broadcast(camera_cone_.spread);
    const Float8 one = broadcast(1.0f);
    if constexpr (any) path.eta_scale = one, path.path_flags = UInt8{} + was_specular;
    path.throughput = {one, one, one};
    Vec2x8 film{};
    for (uint32_t i = 0; i < n; ++i) {
        const SampleId& id = w_.slots[first + i];
        const uint32_t number = id.sample / view_.plan.samples_per_path();
        const uint64_t key = Sampler::key_of(w_.seed_of(settings_, number), uint64_t{id.y} * width + id.x, 0);
        const Color importance = view_.plan.importance_at(id.x, id.y);
        path.slot[i] = first + i, path.sample[i] = settings_.sample_of(number);
        path.key.low[i] = static_cast<uint32_t>(key), path.key.high[i] = static_cast<uint32_t>(key >> 32);
        path.importance.x[i] = importance.r, path.importance.y[i] = importance.g, path.importance.z[i] = importance.b;
        film.x[i] = static_cast<float>(id.x) + 0.5f, film.y[i] = static_cast<float>(id.y) + 0.5f;
    }
    const Vec2x8 offset = settings_.filter.sample(numbers(path.key, 0, Dim::pixel).get2(path.sample));
    film.x += offset.x, film.y += offset.y;
    Vec3x8 org = broadcast(camera.position()), dir;
    if (camera.is_pinhole() && camera.is_still() && !moves_) {
        dir = camera.middle_directions(film);
    } else {
        const Vec2x8 lens = numbers(path.key, 0, Dim::lens).get2(path.sample);
        const Float8 time = camera.is_still() && !moves_ ? Float8{} : numbers(path.key, 0, Dim::time).get1(path.sample);
        for (uint32_t i = 0; i < n; ++i) {
            if (moves_) w_.times[first + i] = time[i];
            const Ray ray = camera.ray({film.x[i], film.y[i]}, {lens.x[i], lens.y[i]}, time[i]);
            set_lane(org, i, ray.org), set_lane(dir, i, ray.dir);
        }
    }
    const uint32_t all = (1u << n) - 1;
    now_.push(all, org, dir, broadcast(Ray{}.t_max), path);
    now_.set_leaf_hints(all, UInt8{} + Ray::no_leaf_hint);
    set_alpha_keys(now_, all, path, 0, Dim::alpha);
}

// Reports the camera rays and their hits to the listener. Ray i is that of slot i.
template <Shading shading>
template <class Listener>
inline void WideBatch<shading>::report_camera_hits(const Listener& listener, size_t first,
                                                   std::span<const Hit> hits) const
{
    PathState s;
    s.cone = camera_cone_;
    for (size_t i = 0; i < hits.size(); ++i) {
        s.slot = static_cast<uint32_t>(first + i);
        s.ray = now_.rays()[first + i];
        listener.ray(s, hits[i]);
        if (hits[i]) listener.vertex(s, view_.surface_at(s.ray, hits[i], s.cone));
    }
}

// Shades the hits of n rays, at most at_once. Each step is done for all of them before the next one, so that its code
// stays in the instruction cache.
template <Shading shading>
inline void WideBatch<shading>::shade(size_t first, size_t n)
{
    if constexpr (any) queues_.for_all([](auto& queue) { queue.clear(); });
    size_t met = 0;
    for (size_t i = 0; i < n; i += float_lanes)
        if (find_vertices(first + i, std::min<size_t>(float_lanes, n - i), vertices_[met])) ++met;
    const std::span vertices = std::span(vertices_).first(met);
    if constexpr (textured) {
        for (Vertices& v : vertices) find_surfaces(v);
        for (Vertices& v : vertices) lookup_materials(v);
    }
    if constexpr (any) queues_.for_all([](auto& queue) { queue.see(); });
    if (arrivals_)
        for (const Vertices& v : vertices)
            for_each_lane(v.hit,
                          [&](uint32_t i) { arrivals_->vertex(v.path.slot[i], lane(v.origin, i), lane(v.n, i)); });
    if (samples_) sample_direct(vertices);
    if constexpr (any)
        scatter_any(vertices);
    else
        for (Vertices& v : vertices) scatter(v);
}

// Sets Ray::key of the rays that were just appended; see View::set_alpha_key().
template <Shading shading>
template <class Of>
inline void WideBatch<shading>::set_alpha_keys(PackedStates<Of>& sent, uint32_t lanes, const PathLanes& path,
                                               uint32_t bounce, Dim dim)
{
    if constexpr (!textured) return;
    if (!view_.scene.geometry.alpha_test.passes_through) return;
    const AddressLanes address = numbers(path.key, bounce, dim);
    Ray* ray = sent.last_rays(static_cast<size_t>(std::popcount(lanes))).data();
    for_each_lane(lanes, [&](uint32_t i) { (ray++)->key = address.key(i, path.sample[i]); });
}

// See render/kernel/batch.h. The listener receives camera rays and their hits only.
template <Shading shading, class Listener>
inline void trace_batch(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                        const KernelSettings& settings, const WidePath<shading>& integrator, Workspace& w,
                        Counters& counters, const Listener& listener)
{
    WideBatch<shading>(view, accel, camera, width, settings, integrator, w, counters).trace(listener);
}

}  // namespace lancer
