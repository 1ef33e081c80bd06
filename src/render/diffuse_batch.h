// The loop over rays for scenes that are plain enough (scene/diffuse_scene.h): what trace_batch() does with the path
// integrator, and the same bits of each sample, eight paths at a time.
#pragma once

#include "core/frame.h"
#include "core/warp.h"
#include "integrators/path.h"
#include "render/workspace.h"
#include "scene/diffuse_light.h"
#include "scene/light_tree.h"
#include "scene/triangle_place.h"

namespace lancer {

struct DiffusePath {
    const Path& path;
    const DiffuseScene& scene;

    void miss(const View& view, const State& s, Steps& steps) const { path.miss(view, s, steps); }
};

class DiffuseBatch {
public:
    DiffuseBatch(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                 const KernelSettings& settings, const DiffusePath& integrator, Workspace& w, Counters& counters)
        : view_(view),
          accel_(accel),
          settings_(settings),
          path_(integrator.path),
          scene_(integrator.scene),
          w_(w),
          now_(w.diffuse.now),
          next_(w.diffuse.next),
          shadows_(w.diffuse.shadows),
          counters_(counters),
          // Where there is nothing but a constant sky to sample, nothing is.
          samples_(path_.direct.nee && !scene_.lights.empty()),
          keeps_normals_(samples_ && view.scene.lights.tree)
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
        PathLanes path;
        Vec3x8 albedo;
        Vec3x8 n, ns, origin;  // as in Surface
        Float8 cos_o;          // between the shading normal and the way back
    };

    void send_from(const Camera& camera, uint32_t width, uint32_t first);
    void shade(size_t first);
    LightSampleLanes sample_light(const Vertices& v, const AddressLanes& address, const Vec2x8& u);
    void sample_direct(const Vertices& v);
    void scatter(Vertices& v);
    struct Survival {
        Float8 probability;
        bool is_certain;  // in all lanes
    };
    Survival survival(const Vertices& v, const Vec3x8& throughput) const;
    void add_emission(size_t i, const PathLanes& path, uint32_t lane);
    void add_unoccluded();
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
    PackedStates<PathLanes>&now_, &next_;
    PackedStates<ShadowLanes>& shadows_;
    Counters& counters_;
    bool samples_;        // lights, at each vertex
    bool keeps_normals_;  // see DiffuseWorkspace
    uint32_t depth_ = 0;
};

inline void DiffuseBatch::send_from(const Camera& camera, uint32_t width, uint32_t first)
{
    const size_t n = std::min<size_t>(float_lanes, w_.slots.size() - first);
    PathLanes path{};
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
}

inline void DiffuseBatch::shade(size_t first)
{
    const size_t n = std::min<size_t>(float_lanes, now_.size() - first);
    const std::span<const Hit> hits = std::span(w_.hits).subspan(first, n);
    Vertices v;
    now_.load(first, v.path);
    v.hit = 0;
    for (uint32_t i = 0; i < n; ++i) v.hit |= static_cast<uint32_t>(bool{hits[i]}) << i;
    const Color sky = view_.scene.environment;
    if (path_.parts.has(leg()) && !is_black(sky))
        for_bits(~v.hit & ((1u << n) - 1), [&](uint32_t i) {
            const Vec3 t = lane(v.path.throughput, i);
            Steps(w_.queue, v.path.slot[i]).add(Color{t.x, t.y, t.z} * sky);
        });
    if (v.hit == 0) return;

    // Lanes without a hit do as the first that has one.
    std::array<size_t, float_lanes> which;
    std::array<const DiffuseScene::Row*, float_lanes> albedo;
    const auto some = static_cast<size_t>(std::countr_zero(v.hit));
    uint32_t shining = 0;
    for (uint32_t i = 0; i < float_lanes; ++i) {
        which[i] = v.hit >> i & 1 ? i : some;
        const Hit& hit = hits[which[i]];
        const uint32_t material = view_.scene.shading[hit.geometry].material_of(hit.primitive);
        albedo[i] = &scene_.albedo[material];
        shining |= static_cast<uint32_t>(scene_.shines[material]) << i;
    }
    for_bits(v.hit & shining, [&](uint32_t i) { add_emission(first + i, v.path, i); });
    if (is_last()) return;
    v.albedo = turned(albedo).xyz;

    const auto four = [&](size_t from) {
        return places_of(view_.scene, hits, {which[from], which[from + 1], which[from + 2], which[from + 3]});
    };
    const PlacesOfFour low = four(0), high = four(4);
    const Vec3x8 p = joined(low.p, high.p), p_error = joined(low.p_error, high.p_error);
    const Vec3x8 wo = -RayOctet(now_.rays().subspan(first, n)).dir;
    v.n = joined(low.n, high.n), v.ns = joined(low.ns, high.ns);
    // As surface_at() has it.
    const Float8 zero{};
    const Mask8 front = dot(v.n, wo) > zero;
    v.n = select(front, v.n, -v.n), v.ns = select(front, v.ns, -v.ns);
    v.origin = offset_origin(p, p_error, v.n, v.n);
    const Float8 c = dot(v.ns, wo);
    if (bits(c < zero) != 0) v.ns = select(c < zero, normalize(v.ns - wo * (2.0f * c)), v.ns);
    v.cos_o = dot(wo, v.ns);

    if (samples_ && path_.parts.has(leg_after(leg(), false))) sample_direct(v);
    scatter(v);
}

inline void DiffuseBatch::add_emission(size_t i, const PathLanes& path, uint32_t in)
{
    State s;
    const Vec3 t = lane(path.throughput, in);
    s.ray = now_.rays()[i];
    s.throughput = {t.x, t.y, t.z};
    s.pdf = path.pdf[in];
    if (keeps_normals_ && depth_ > 0) s.normal = w_.diffuse.normals_now[i];
    s.light_sampled = samples_ && depth_ > 0;
    s.leg = leg();
    Steps steps(w_.queue, path.slot[in]);
    lancer::add_emission(view_, s, view_.surface_at(s.ray, w_.hits[i], {}), path_.direct, path_.parts, steps);
}

// View::sample_light()
inline LightSampleLanes DiffuseBatch::sample_light(const Vertices& v, const AddressLanes& address, const Vec2x8& u)
{
    const Discrete& pick = view_.scene.lights.pick;
    if (pick.stretches()) {
        Discrete::StretchedLanes chosen{{}, u.x};
        if (pick.size() > 1) chosen = pick.stretch(u.x);
        return sample_lights(scene_, chosen.index, v.origin, {chosen.u, u.y});
    }
    const Float8 number = address.get1(v.path.sample);
    std::array<uint32_t, float_lanes> ids{};
    if (!view_.scene.lights.tree) {
        for (uint32_t i = 0; i < float_lanes; ++i) ids[i] = pick.sample(lengthened(number[i], Vec2{u.x[i], u.y[i]}));
        return sample_lights(scene_, ids, v.origin, u);
    }
    std::array<double, float_lanes> numbers;
    for (uint32_t i = 0; i < float_lanes; ++i) numbers[i] = lengthened(number[i], Vec2{u.x[i], u.y[i]});
    std::array<LightTree::Choice, float_lanes> choices{};
    view_.scene.lights.tree->choose(v.origin, v.ns, numbers, v.hit, choices);
    Float8 probability{};
    for (uint32_t i = 0; i < float_lanes; ++i) ids[i] = choices[i].light, probability[i] = choices[i].probability;
    return sample_lights(scene_, ids, v.origin, u, &probability);
}

inline void DiffuseBatch::sample_direct(const Vertices& v)
{
    const AddressLanes address = numbers(v.path.key, depth_, Dim::light);
    const Vec2x8 u = address.get2(v.path.sample);
    const LightSampleLanes light = sample_light(v, address, u);
    const Float8 zero{}, cos_i = dot(light.wi, v.ns);
    const Float8 pdf = cos_i * (1 / pi);
    const Vec3x8 f_cos = v.albedo * pdf;
    const Mask8 lit = light.found & (dot(light.wi, v.n) > zero) & (cos_i > zero) & (v.cos_o > zero) & ~is_black(f_cos);
    if ((bits(lit) & v.hit) == 0) return;
    Float8 weight = all_lanes(1.0f);
    if (path_.direct.mis) {
        const Float8 r = pdf / light.pdf;
        weight = 1.0f / (1.0f + r * r);
    }
    const Vec3x8 radiance = times(times(v.path.throughput, f_cos), light.radiance) * (weight / light.pdf);
    const uint32_t wanted = bits(lit & ~is_black(radiance)) & v.hit;
    if (wanted == 0) return;
    // shadow_ray()
    const Float8 reach = length(light.point - v.origin) * gamma(16);
    const Vec3x8 end = offset_origin(light.point, light.p_error + Vec3x8{reach, reach, reach}, light.n, -light.wi);
    const Vec3x8 d = end - v.origin;
    const Float8 distance = length(d);
    const Vec3x8 dir = d / distance;
    const uint32_t traceable = bits(is_traceable(v.origin, dir, all_lanes(Ray{}.t_min), distance));
    spoil(wanted & ~traceable, v.path.slot);
    shadows_.push(wanted & traceable, v.origin, dir, distance, {radiance, v.path.slot});
}

inline void DiffuseBatch::scatter(Vertices& v)
{
    const PathPlan& plan = view_.plan;
    const bool splits = depth_ == 0 && plan.parts > 1;
    const Float8 zero{}, no_end = all_lanes(std::numeric_limits<float>::infinity());
    Mask8 reflects = (v.cos_o > zero) & ~is_black(v.albedo);
    if ((bits(reflects) & v.hit) == 0) return;
    PathLanes& next = v.path;  // from here on that of what is sent on
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
        next_.push(wanted & traceable, v.origin, wi, no_end, next);
        if (keeps_normals_)
            for_bits(wanted & traceable, [&](uint32_t i) { w_.diffuse.normals_next.push_back(lane(v.ns, i)); });
    }
}

// With what probability roulette lets a ray go on to the next depth: see survives_roulette().
inline DiffuseBatch::Survival DiffuseBatch::survival(const Vertices& v, const Vec3x8& throughput) const
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

inline void DiffuseBatch::add_unoccluded()
{
    w_.occluded.resize(shadows_.size());
    accel_.any(shadows_.rays(), w_.occluded);
    counters_.shadow_rays += shadows_.size();
    for (size_t first = 0; first < shadows_.size(); first += float_lanes) {
        ShadowLanes shadow;
        shadows_.load(first, shadow);
        for (size_t i = 0; i < std::min<size_t>(float_lanes, shadows_.size() - first); ++i) {
            if (w_.occluded[first + i]) continue;
            const Vec3 brought = lane(shadow.radiance, i);
            w_.queue.radiance[shadow.slot[i]] += Color{brought.x, brought.y, brought.z};
        }
    }
}

// See render/batch.h.
inline void trace_batch(const View& view, const Accelerator& accel, const Camera& camera, uint32_t width,
                        const KernelSettings& settings, const DiffusePath& integrator, Workspace& w, Counters& counters,
                        const NoListener&)
{
    DiffuseBatch(view, accel, camera, width, settings, integrator, w, counters).trace();
}

}  // namespace lancer
