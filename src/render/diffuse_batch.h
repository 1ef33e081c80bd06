// The loop over rays for scenes that are plain enough (scene/diffuse_scene.h): what trace_batch() does with the path
// integrator, and the same bits of each sample, eight paths at a time.
#pragma once

#include <algorithm>

#include "core/frame.h"
#include "core/warp.h"
#include "integrators/path.h"
#include "render/workspace.h"
#include "scene/diffuse_light.h"
#include "scene/light_tree.h"
#include "scene/triangle_place.h"

namespace lancer {

// looks_up: see DiffuseScene.
template <bool looks_up>
struct DiffusePath {
    const Path& path;
    const DiffuseScene& scene;

    void miss(const View& view, const State& s, Steps& steps) const { path.miss(view, s, steps); }
};

template <bool looks_up>
class DiffuseBatch {
    using Lanes = std::conditional_t<looks_up, ConePathLanes, PathLanes>;

public:
    DiffuseBatch(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                 const KernelSettings& settings, const DiffusePath<looks_up>& integrator, Workspace& w,
                 Counters& counters)
        : view_(view),
          accel_(accel),
          settings_(settings),
          path_(integrator.path),
          scene_(integrator.scene),
          w_(w),
          now_(std::get<PathsUnderWay<Lanes>>(w.diffuse.paths).now),
          next_(std::get<PathsUnderWay<Lanes>>(w.diffuse.paths).next),
          shadows_(w.diffuse.shadows),
          counters_(counters),
          samples_(path_.direct.nee && !view.scene.lights.pick.empty() && !view.lit_by_constant_sky()),
          samples_sky_(looks_up && samples_ && view.scene.environment_light != Scene::none),
          keeps_normals_(samples_ && (samples_sky_ || view.scene.lights.tree)),
          shines_(std::find(scene_.shines.begin(), scene_.shines.end(), true) != scene_.shines.end())
    {
        const size_t most = w.slots.size() * view.plan.split;
        now_.reserve(most), next_.reserve(most), shadows_.reserve(most);
        w.queue.radiance.assign(w.slots.size(), RadianceSum{});
        w.hits.reserve(most);
        w.occluded.reserve(most);
        now_.clear();
        for (uint32_t first = 0; first < w.slots.size(); first += float_lanes) send_from(camera, width, first);
        counters.camera_rays += w.slots.size();
    }
    void trace()
    {
        for (depth_ = 0; now_.size() > 0; ++depth_) {
            if (depth_ > 0) counters_.bounce_rays += now_.size();
            next_.clear(), shadows_.clear();
            w_.diffuse.normals_next.clear();
            if (is_last() && !shines_) return end_in_sky();
            w_.hits.resize(now_.size());
            for (size_t first = 0; first < now_.size(); first += at_once) {
                const size_t n = std::min(at_once, now_.size() - first);
                const std::span<Hit> hits = std::span(w_.hits).subspan(first, n);
                accel_.closest(now_.rays().subspan(first, n), hits,
                               depth_ == 0 ? Coherence::coherent : Coherence::incoherent);
                fetch_shading(view_.scene, hits);
                for (size_t i = first; i < first + n; i += float_lanes) shade(i);
            }
            add_unoccluded();
            std::swap(now_, next_);
            std::swap(w_.diffuse.normals_now, w_.diffuse.normals_next);
        }
    }

private:
    // Rays that are traced before the first is shaded: so few that what was looked up for their hits is still near.
    static constexpr size_t at_once = 128;
    // Eight vertices.
    struct Vertices {
        uint32_t hit;  // lanes that there are
        Lanes path;
        Vec3x8 albedo;
        Vec3x8 n, ns, origin;  // as in Surface
        Float8 cos_o;          // between the shading normal and the way back
        Float8 width;          // of the cone, where textures are looked up
    };

    void send_from(const Camera& camera, uint32_t width, uint32_t first);
    void shade(size_t first);
    void look_up(size_t first, std::span<const Hit> hits, Vertices& v);
    LightSampleLanes sample_light(const Vertices& v, const AddressLanes& address, const Vec2x8& u);
    LightSampleLanes sample_any_light(const Vertices& v, const AddressLanes& address, const Vec2x8& u);
    void sample_direct(const Vertices& v);
    void scatter(Vertices& v);
    struct Survival {
        Float8 probability;
        bool is_certain;  // in all lanes
    };
    Survival survival(const Vertices& v, const Vec3x8& throughput) const;
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
    // Whether only emission counts where the rays of this depth end.
    bool is_last() const
    {
        return depth_ > 0 && (depth_ == path_.max_depth || (leg() == Leg::direct && !path_.parts.indirect));
    }
    AddressLanes numbers(const KeyLanes& key, uint32_t bounce, Dim dim) const
    {
        return {settings_.sampler, key, bounce, dim};
    }

    const View& view_;
    const Accelerator& accel_;
    const KernelSettings& settings_;
    const Path& path_;
    const DiffuseScene& scene_;
    Workspace& w_;
    PackedStates<Lanes>&now_, &next_;
    PackedStates<ShadowLanes>& shadows_;
    Counters& counters_;
    // Lights, at each vertex. Where there is nothing but a constant sky to sample, nothing is.
    bool samples_;
    bool samples_sky_;    // as one of them
    bool keeps_normals_;  // see DiffuseWorkspace
    bool shines_;         // whether any surface does
    uint32_t depth_ = 0;
};

template <bool looks_up>
inline void DiffuseBatch<looks_up>::send_from(const Camera& camera, uint32_t width, uint32_t first)
{
    const size_t n = std::min<size_t>(float_lanes, w_.slots.size() - first);
    Lanes path{};
    if constexpr (looks_up) path.spread = all_lanes(camera.pixel_spread());
    const Float8 one = all_lanes(1.0f);
    path.throughput = {one, one, one};
    for (uint32_t i = 0; i < n; ++i) {
        const SampleId& id = w_.slots[first + i];
        const uint32_t number = id.sample / view_.plan.of_path();
        const uint64_t key = Sampler::key_of(w_.seed_of(settings_, number), uint64_t{id.y} * width + id.x, 0);
        const Color worth = view_.plan.worth_at(id.x, id.y);
        path.slot[i] = first + i, path.sample[i] = settings_.sample_of(number);
        path.key.low[i] = static_cast<uint32_t>(key), path.key.high[i] = static_cast<uint32_t>(key >> 32);
        path.worth.x[i] = worth.r, path.worth.y[i] = worth.g, path.worth.z[i] = worth.b;
    }
    const Vec2x8 on_pixel = numbers(path.key, 0, Dim::pixel).get2(path.sample);
    const Vec2x8 on_lens = camera.is_pinhole() ? Vec2x8{} : numbers(path.key, 0, Dim::lens).get2(path.sample);
    std::array<Ray, float_lanes> rays;
    for (uint32_t i = 0; i < n; ++i) {
        const SampleId& id = w_.slots[first + i];
        const Vec2 offset = settings_.filter.sample({on_pixel.x[i], on_pixel.y[i]});
        rays[i] = camera.ray({static_cast<float>(id.x) + 0.5f + offset.x, static_cast<float>(id.y) + 0.5f + offset.y},
                             {on_lens.x[i], on_lens.y[i]});
    }
    now_.push((1u << n) - 1, std::span(rays).first(n), path);
    give_keys(now_, (1u << n) - 1, path, 0, Dim::hole);
}

template <bool looks_up>
inline void DiffuseBatch<looks_up>::shade(size_t first)
{
    const size_t n = std::min<size_t>(float_lanes, now_.size() - first);
    const std::span<const Hit> hits = std::span(w_.hits).subspan(first, n);
    Vertices v;
    now_.load(first, v.path);
    v.hit = 0;
    for (uint32_t i = 0; i < n; ++i) v.hit |= static_cast<uint32_t>(bool{hits[i]}) << i;
    add_sky(~v.hit & ((1u << n) - 1), first, v.path);
    if (v.hit == 0) return;

    // Lanes without a hit do as the first that has one.
    std::array<size_t, float_lanes> which;
    std::array<const DiffuseScene::Row*, float_lanes> albedo;
    const auto some = static_cast<size_t>(std::countr_zero(v.hit));
    uint32_t shining = 0;
    for (uint32_t i = 0; i < float_lanes; ++i) {
        which[i] = v.hit >> i & 1 ? i : some;
        const Hit& hit = hits[which[i]];
        const uint32_t material =
            looks_up ? view_.scene.material_of(hit) : view_.scene.shading[hit.geometry].material_of(hit.primitive);
        albedo[i] = &scene_.albedo[material];
        shining |= static_cast<uint32_t>(scene_.shines[material]) << i;
    }
    for_bits(v.hit & shining, [&](uint32_t i) { add_emission(first + i, v.path, i); });
    if (is_last()) return;
    const Vec3x8 wo = -RayOctet(now_.rays().subspan(first, n)).dir;
    if constexpr (looks_up) {
        look_up(first, hits, v);
    } else {
        v.albedo = turned(albedo).xyz;
        const auto four = [&](size_t from) {
            return places_of(view_.scene, hits, {which[from], which[from + 1], which[from + 2], which[from + 3]});
        };
        const PlacesOfFour low = four(0), high = four(4);
        const Vec3x8 p = joined(low.p, high.p), p_error = joined(low.p_error, high.p_error);
        v.n = joined(low.n, high.n), v.ns = joined(low.ns, high.ns);
        // As surface_at() has it.
        const Float8 zero{};
        const Mask8 front = dot(v.n, wo) > zero;
        v.n = select(front, v.n, -v.n), v.ns = select(front, v.ns, -v.ns);
        v.origin = offset_origin(p, p_error, v.n, v.n);
        const Float8 c = dot(v.ns, wo);
        if (bits(c < zero) != 0) v.ns = select(c < zero, normalize(v.ns - wo * (2.0f * c)), v.ns);
    }
    v.cos_o = dot(wo, v.ns);

    if (samples_ && path_.parts.has(leg_after(leg(), false))) sample_direct(v);
    scatter(v);
}

// One place after the other: what textures and maps say of it differs in how it is found.
template <bool looks_up>
inline void DiffuseBatch<looks_up>::look_up(size_t first, std::span<const Hit> hits, Vertices& v)
{
    std::array<TrianglePlace, float_lanes> places;
    view_.triangle_places(hits, places);
    const Float8 zero{}, one = all_lanes(1.0f);
    v.albedo = v.origin = {zero, zero, zero};
    v.n = v.ns = {zero, zero, one};
    v.width = zero;
    for_bits(v.hit, [&](uint32_t i) {
        const RayCone cone{v.path.width[i], v.path.spread[i]};
        const Surface s = view_.surface_at(now_.rays()[first + i], hits[i], cone, places[i]);
        const auto* lambert = std::get_if<Lambert>(&view_.scene.materials[s.material]);
        const Color albedo = lambert ? view_.bsdf_at(*lambert, s).albedo : Color{};
        set_lane(v.albedo, i, {albedo.r, albedo.g, albedo.b});
        set_lane(v.n, i, s.n);
        set_lane(v.ns, i, s.ns);
        set_lane(v.origin, i, s.origin);
        v.width[i] = cone.width + cone.spread * s.t;
    });
}

// To those of the lanes that were just sent. See View::give_key().
template <bool looks_up>
template <class Of>
inline void DiffuseBatch<looks_up>::give_keys(PackedStates<Of>& sent, uint32_t lanes, const PathLanes& path,
                                              uint32_t bounce, Dim dim)
{
    if constexpr (!looks_up) return;
    if (!view_.scene.geometry.holes.let_pass) return;
    const AddressLanes address = numbers(path.key, bounce, dim);
    Ray* ray = sent.last_rays(static_cast<size_t>(std::popcount(lanes))).data();
    for_bits(lanes, [&](uint32_t i) { (ray++)->key = address.key(i, path.sample[i]); });
}

template <bool looks_up>
inline void DiffuseBatch<looks_up>::scatter(Vertices& v)
{
    const PathPlan& plan = view_.plan;
    const bool splits = depth_ == 0 && plan.parts > 1;
    const Float8 zero{}, no_end = all_lanes(std::numeric_limits<float>::infinity());
    Mask8 reflects = (v.cos_o > zero) & ~is_black(v.albedo);
    if ((bits(reflects) & v.hit) == 0) return;
    Lanes& next = v.path;  // from here on that of what is sent on
    Float8 spread{};
    if constexpr (looks_up) next.width = v.width, spread = next.spread;
    if (splits) {
        for_bits(v.hit, [&](uint32_t i) {
            next.sample[i] = next.sample[i] * plan.parts + w_.slots[next.slot[i]].sample % plan.of_path();
        });
        next.throughput = next.throughput / all_lanes(static_cast<float>(plan.split));
    }
    next.throughput = times(next.throughput, v.albedo);
    reflects &= ~is_black(next.throughput);
    if ((bits(reflects) & v.hit) == 0) return;
    const auto [q, is_certain] = survival(v, next.throughput);
    if (!is_certain) next.throughput = next.throughput / q;
    const FrameT<Float8> frame(v.ns);
    const AddressLanes address = numbers(next.key, depth_, Dim::bsdf);
    const AddressLanes roulette = numbers(next.key, depth_ + 1, Dim::roulette);
    for (uint32_t part = 0; part < (splits ? plan.split : 1); ++part, next.sample += 1u) {
        const Vec2x8 u = address.get2(next.sample);
        const Vec3x8 local = square_to_cosine_hemisphere(u.x, u.y);
        const Vec3x8 wi = normalize(frame.to_world(local));
        Mask8 goes = reflects & (local.z > zero) & ~(dot(wi, v.n) < zero);
        if (!is_certain) goes &= roulette.get2_x(next.sample) < q;
        const uint32_t wanted = bits(goes) & v.hit,
                       traceable = bits(is_traceable(v.origin, wi, all_lanes(Ray{}.t_min), no_end));
        spoil(wanted & ~traceable, next.slot);
        next.pdf = local.z * (1 / pi);
        if constexpr (looks_up) next.spread = opened(spread, next.pdf);
        next_.push(wanted & traceable, v.origin, wi, no_end, next);
        give_keys(next_, wanted & traceable, next, depth_ + 1, Dim::hole);
        if (keeps_normals_)
            for_bits(wanted & traceable, [&](uint32_t i) { w_.diffuse.normals_next.push_back(lane(v.ns, i)); });
    }
}

// With what probability roulette lets a ray go on to the next depth: see survives_roulette().
template <bool looks_up>
inline typename DiffuseBatch<looks_up>::Survival DiffuseBatch<looks_up>::survival(const Vertices& v,
                                                                                  const Vec3x8& throughput) const
{
    const bool is_deep = depth_ + 1 >= path_.roulette_depth;
    const Float8 cap = all_lanes(is_deep ? roulette_cap : 1.0f);
    if (view_.plan.worth.empty()) {
        if (!is_deep) return {cap, true};
        return {min(max(throughput.x, max(throughput.y, throughput.z)), cap), false};
    }
    const Vec3x8 part = times(throughput, v.path.worth);
    const Float8 of_pixel = sqrt(part.x * part.x + part.y * part.y + part.z * part.z);
    const Float8 of_path = of_pixel * static_cast<float>(view_.plan.parts > 1 ? view_.plan.split : 1);
    const Float8 q = min(max(roulette_rays * of_path, all_lanes(least_survival)), cap);
    return {q, (bits(q != all_lanes(1.0f)) & v.hit) == 0};
}

// See render/batch.h.
template <bool looks_up>
inline void trace_batch(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                        const KernelSettings& settings, const DiffusePath<looks_up>& integrator, Workspace& w,
                        Counters& counters, const NoListener&)
{
    DiffuseBatch<looks_up>(view, accel, camera, width, settings, integrator, w, counters).trace();
}

}  // namespace lancer
