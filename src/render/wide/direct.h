// Direct light of a WideBatch: emission hit by its rays, and light sampling.
#pragma once

#include "render/wide/batch.h"

namespace lancer {

// The state of one lane for the scalar functions; i: index of its ray.
template <Shading shading>
inline PathState WideBatch<shading>::state_of(size_t i, const Lanes& path, uint32_t in) const
{
    PathState s;
    const Vec3 t = lane(path.throughput, in);
    s.ray = now_.rays()[i];
    s.throughput = {t.x, t.y, t.z};
    s.pdf = path.pdf[in];
    if constexpr (textured) s.cone = {path.width[in], path.spread[in]};
    if (keeps_normals_ && depth_ > 0) s.normal = w_.wide.normals_now[i];
    if (keeps_cells_ && depth_ > 0) s.cell = w_.wide.cells_now[i];
    if (by_mirrors_ && depth_ > 0) s.mirror_distance = w_.wide.mirror_distances_now[i];
    if constexpr (any) {
        const uint32_t path_flags = path.path_flags[in];
        s.specular = (path_flags & was_specular) != 0;
        s.light_sampled = (path_flags & has_sampled_light) != 0;
        s.segment = segment_of(path.path_flags, in);
    } else {
        s.specular = depth_ == 0;
        s.light_sampled = samples_ && depth_ > 0;
        s.segment = segment();
    }
    return s;
}

template <Shading shading>
inline void WideBatch<shading>::add_emission(size_t i, const Lanes& path, uint32_t in)
{
    const PathState s = state_of(i, path, in);
    PathActions actions(w_.queue, path.slot[in]);
    lancer::add_emission(view_, s, view_.surface_at(s.ray, w_.hits[i], s.cone), path_.direct, path_.parts, actions);
}

// Adds the background to lanes whose rays hit nothing; `first`: index of the first lane's ray.
template <Shading shading>
inline void WideBatch<shading>::add_background(uint32_t missed, size_t first, const Lanes& path)
{
    if (missed == 0) return;
    if constexpr (any) {
        if (!path_.parts.has_all())
            for_each_lane(missed, [&](uint32_t i) {
                missed &= ~(uint32_t{!path_.parts.has(segment_of(path.path_flags, i))} << i);
            });
    } else if (!path_.parts.has(segment())) {
        return;
    }
    uint32_t plain = missed;  // lanes with MIS weight 1
    if constexpr (textured) {
        if (!view_.scene.has_uniform_background())
            plain = 0;
        else if constexpr (any)
            plain &= ~movemask(is_set(path.path_flags, has_sampled_light));
        else if (samples_sky_)
            plain = 0;
    }
    if (arrivals_) plain = 0;  // they are reported
    const Color sky = view_.scene.environment;
    if (!is_black(sky))
        for_each_lane(plain, [&](uint32_t i) {
            const Vec3 t = lane(path.throughput, i);
            PathActions(w_.queue, path.slot[i]).add(Color{t.x, t.y, t.z} * sky);
        });
    for_each_lane(missed & ~plain, [&](uint32_t i) {
        PathActions actions(w_.queue, path.slot[i]);
        const PathState s = state_of(first + i, path, i);
        const RadianceSum before = w_.queue.radiance[path.slot[i]];
        add_environment(view_, s, path_.direct, path_.parts, actions);
        if (arrivals_) arrivals_->sky(path.slot[i], s, w_.queue.radiance[path.slot[i]].since(before));
    });
}

// Handles rays for which only emission counts when no surface emits: an occlusion test is enough.
template <Shading shading>
inline void WideBatch<shading>::end_at_background()
{
    w_.occluded.resize(now_.size());
    accel_.any(now_.rays(), w_.occluded);
    for (size_t first = 0; first < now_.size(); first += float_lanes) {
        Lanes path;
        now_.load(first, path);
        uint32_t missed = 0;
        for (size_t i = 0; i < std::min<size_t>(float_lanes, now_.size() - first); ++i)
            missed |= (w_.occluded[first + i] ? 0u : 1u) << i;
        add_background(missed, first, path);
    }
}

// Lanes for which light is sampled; see samples_light().
template <Shading shading>
inline uint32_t WideBatch<shading>::light_sampling_lanes(const Vertices& v) const
{
    const Float8 zero{};
    uint32_t active = samples_on_matt_ ? v.hit & movemask((v.cos_o > zero) & ~is_black(v.albedo)) : 0;
    if constexpr (any) active |= v.hit & v.non_lambert.lanes & ~v.non_lambert.only_delta & movemask(v.cos_o > zero);
    return active;
}

// Those of v.samples_light whose direct light is part of the picture.
template <Shading shading>
inline uint32_t WideBatch<shading>::shown_lanes(const Vertices& v) const
{
    uint32_t active = v.samples_light;
    if constexpr (!any) return path_.parts.has(segment_after(segment(), false)) ? active : 0;
    if constexpr (any) {
        if (path_.parts.has_all()) return active;
        for_each_lane(active, [&](uint32_t i) {
            if (!path_.parts.has(segment_after(segment_of(v.path.path_flags, i), false))) active &= ~(1u << i);
        });
        return active;
    }
}

// Finds the cells of all lanes, as rays by BSDF sampling need them. Returns the lanes that go on with light sampling.
template <Shading shading>
inline uint32_t WideBatch<shading>::lanes_by_rate(uint32_t lanes, Vertices& v) const
{
    const LightChoice& choice = view_.plan.light_choice;
    v.light_cell = UInt8{}, v.light_rate = broadcast(1.0f);
    for_each_lane(v.hit, [&](uint32_t i) {
        v.light_cell[i] = choice.cell_of(lane(v.origin, i), lane(v.n, i));
        v.light_rate[i] = choice.rate(v.light_cell[i]);
    });
    const Mask8 certain = v.light_rate == broadcast(1.0f);
    if ((lanes & ~movemask(certain)) == 0) return lanes;
    const Float8 u = numbers(v.path.key, depth_, Dim::roulette).get1(v.path.sample);
    return lanes & movemask(certain | (u < v.light_rate));
}

template <Shading shading>
inline void WideBatch<shading>::query_light(Vertices& v, LightQuery& query)
{
    v.samples_light = light_sampling_lanes(v);
    if (learned_) v.samples_light = lanes_by_rate(v.samples_light, v);
    query.active = shown_lanes(v), query.by_place = keeps_cells_;
    if (query.active == 0) return;
    const AddressLanes address = numbers(v.path.key, depth_, Dim::light);
    const Vec2x8 u = address.get2(v.path.sample);
    sample_light(v, address, u, query);
    if (learned_) query.light.pdf *= v.light_rate;
    if constexpr (any) {
        const uint32_t non_lambert = query.active & v.non_lambert.lanes & movemask(query.light.found);
        if (non_lambert == 0) return;
        query.wi = FrameT<Float8>(v.ns).to_local(query.light.wi);
        queues_.for_some(v.non_lambert.queued, non_lambert,
                         [&](auto& queue, const LaneQueue::Eight& of) { queue.put_wi(of, query.wi); });
    }
}

// Evaluates the BSDFs that are not Lambertian.
template <Shading shading>
inline void WideBatch<shading>::eval_non_lambert(const Vertices& v, const LightQuery& query, uint32_t lanes,
                                                 Vec3x8& f_cos, Float8& pdf) const
{
    const Float8 zero{};
    const Mask8 disagree = ~sides_agree(v.n, query.light.wi, query.wi.z);
    queues_.for_some(v.non_lambert.queued, lanes, [&](const auto& queue, const LaneQueue::Eight& of) {
        const BsdfValueLanes f = queue.value(of);
        const Mask8 is_asked = lanes_of(lanes & of.lanes);
        f_cos = select(is_asked, select(disagree, {zero, zero, zero}, f.f_cos), f_cos);
        pdf = select(is_asked, select(disagree, zero, f.pdf), pdf);
    });
    for_each_lane(lanes & ~v.non_lambert.queued.lanes(), [&](uint32_t i) {
        BsdfValue f{};
        if ((movemask(disagree) >> i & 1) == 0)
            f = with_bsdf(v.non_lambert, i,
                          [&](const auto& bsdf, const auto& from) { return bsdf.eval(from, lane(query.wi, i)); });
        set_lane(f_cos, i, {f.f_cos.r, f.f_cos.g, f.f_cos.b});
        pdf[i] = f.pdf;
    });
}

template <Shading shading>
inline void WideBatch<shading>::sample_direct(std::span<Vertices> vertices)
{
    if constexpr (any) {
        for (size_t i = 0; i < vertices.size(); ++i) query_light(vertices[i], non_lambert_.query[i]);
        queues_.for_all([](auto& queue) { queue.eval(); });
        for (size_t i = 0; i < vertices.size(); ++i) send_shadows(vertices[i], non_lambert_.query[i]);
        // The mirror is a vertex as well.
        if (by_mirrors_ && path_.parts.indirect && depth_ + 1 != path_.max_depth)
            for (Vertices& v : vertices) sample_mirrored(v);
    } else {
        for (Vertices& v : vertices) {
            LightQuery query;
            query_light(v, query);
            send_shadows(v, query);
        }
    }
}

// Appends the shadow rays.
template <Shading shading>
inline void WideBatch<shading>::send_shadows(const Vertices& v, const LightQuery& to)
{
    if (to.active == 0) return;
    const LightSampleLanes& light = to.light;
    const Float8 zero{}, cos_i = dot(light.wi, v.ns);
    auto [f_cos, pdf] = lambert_value(v.albedo, cos_i);
    Mask8 lit = light.found & (dot(light.wi, v.n) > zero) & (cos_i > zero);
    if constexpr (any) {
        const uint32_t non_lambert = to.active & v.non_lambert.lanes & movemask(light.found);
        if (non_lambert != 0) {
            eval_non_lambert(v, to, non_lambert, f_cos, pdf);
            lit |= lanes_of(non_lambert);
        }
    }
    lit &= lanes_of(to.active) & ~is_black(f_cos);
    if (movemask(lit) == 0) return;
    const Float8 weight = weight_of_light_sample(light.pdf, pdf, textured ? light.delta : Mask8{}, path_.direct);
    const Vec3x8 radiance = sampled_light(v.path.throughput, f_cos, light.radiance, weight / light.pdf);
    const uint32_t wanted = movemask(lit & ~is_black(radiance));
    if (wanted == 0) return;
    Vec3x8 origin = v.origin;
    if constexpr (any)
        for_each_lane(wanted & v.non_lambert.lanes & movemask(dot(light.wi, v.n) < zero),
                      [&](uint32_t i) { set_lane(origin, i, origin_behind(v, i)); });
    auto [dir, distance] = ShadowSegment<Float8>(origin, light);
    if constexpr (textured) {
        dir = select(light.infinite, light.wi, dir);
        distance = select(light.infinite, broadcast(std::numeric_limits<float>::infinity()), distance);
    }
    const uint32_t traceable = movemask(is_traceable(origin, dir, broadcast(Ray{}.t_min), distance));
    invalidate(wanted & ~traceable, v.path.slot);
    uint32_t sent = wanted & traceable;
    if constexpr (any)
        if (view_.scene.passes_glass) {
            const uint32_t through = sent & movemask(light.delta);
            send_through_glass(v, through, to, origin, dir, distance, radiance);
            sent &= ~through;
        }
    shadows_.push(sent, origin, dir, distance, {radiance, v.path.slot});
    if (arrivals_) w_.wide.shadow_lights.push(sent, to.ids);
    set_alpha_keys(shadows_, sent, v.path, depth_, Dim::shadow_alpha);
}

// Requests shadow rays that smooth glass does not stop.
template <Shading shading>
inline void WideBatch<shading>::send_through_glass(const Vertices& v, uint32_t lanes, const LightQuery& query,
                                                   const Vec3x8& origin, const Vec3x8& dir, const Float8& distance,
                                                   const Vec3x8& radiance)
{
    const AddressLanes address = numbers(v.path.key, depth_, Dim::shadow_alpha);
    const auto color = [](Vec3 c) { return Color{c.x, c.y, c.z}; };
    for_each_lane(lanes, [&](uint32_t i) {
        Ray ray{.org = lane(origin, i), .dir = lane(dir, i), .t_max = distance[i]};
        if (view_.scene.geometry.alpha_test.passes_through) ray.key = address.key(i, v.path.sample[i]);
        PathActions(w_.queue, v.path.slot[i])
            .tinted_shadow(ray, color(lane(radiance, i)), color(lane(query.light.radiance, i)), query.ids[i]);
    });
}

template <Shading shading>
inline void WideBatch<shading>::add_unoccluded()
{
    set_times(shadows_);
    w_.occluded.resize(shadows_.size());
    accel_.any(shadows_.rays(), w_.occluded);
    counters_.shadow_rays += shadows_.size();
    for (size_t first = 0; first < shadows_.size(); first += float_lanes) {
        ShadowLanes shadow;
        shadows_.load(first, shadow);
        for (size_t i = 0; i < std::min<size_t>(float_lanes, shadows_.size() - first); ++i) {
            const Vec3 brought = lane(shadow.radiance, i);
            const Color radiance{brought.x, brought.y, brought.z};
            const bool occluded = w_.occluded[first + i] != 0;
            if (arrivals_)
                arrivals_->shadow({.slot = shadow.slot[i], .light = w_.wide.shadow_lights[first + i]},
                                  shadows_.rays()[first + i], radiance, occluded);
            if (!occluded) w_.queue.radiance[shadow.slot[i]] += radiance;
        }
    }
}

}  // namespace lancer
