// Direct light of a WideBatch: emission hit by its rays, and light sampling.
#pragma once

#include "render/wide/batch.h"
#include "scene/environment/constant.h"

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
    const Color sky = view_.scene.environment;
    if (!is_black(sky))
        for_each_lane(plain, [&](uint32_t i) {
            const Vec3 t = lane(path.throughput, i);
            PathActions(w_.queue, path.slot[i]).add(Color{t.x, t.y, t.z} * sky);
        });
    for_each_lane(missed & ~plain, [&](uint32_t i) {
        PathActions actions(w_.queue, path.slot[i]);
        add_environment(view_, state_of(first + i, path, i), path_.direct, path_.parts, actions);
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

// Samples a constant environment for the given lanes, which chose it.
template <Shading shading>
inline void WideBatch<shading>::sample_constant_environment(const Vertices& v, const ChosenLights& chosen,
                                                            uint32_t lanes, LightSampleLanes& s) const
{
    const Scene& scene = view_.scene;
    const Float8 zero{};
    const Mask8 here = lanes_of(lanes);
    const ConstantEnvironmentSample<Float8> sample(v.ns, chosen.u.x, chosen.u.y);
    const Float8 probability = broadcast(scene.lights.pick.probability(scene.environment_light));
    const Color& c = scene.environment;
    s.wi = select(here, sample.wi, s.wi);
    s.pdf = select(here, sample.pdf * (chosen.choice() ? *chosen.choice() : probability), s.pdf);
    s.radiance = select(here, {broadcast(c.r), broadcast(c.g), broadcast(c.b)}, s.radiance);
    s.found |= here & (sample.pdf > zero) & (dot(sample.wi, v.n) > zero);
    s.infinite |= here;
}

// Selects a light for each lane. Few lights are selected by remapping the first number of the light sample, many by a
// number of their own.
template <Shading shading>
inline typename WideBatch<shading>::ChosenLights WideBatch<shading>::choose_lights(const Vertices& v, uint32_t active,
                                                                                   const AddressLanes& address,
                                                                                   const Vec2x8& u) const
{
    const LightTable& lights = view_.scene.lights;
    if (keeps_cells_) {
        const Float8 number = address.get1(v.path.sample);
        ChosenLights chosen{.u = u};
        Float8& probability = chosen.probability.emplace();
        for_each_lane(active, [&](uint32_t i) {
            const LightChoice::Chosen c = view_.plan.light_choice.choose(v.light_cell[i], number[i]);
            chosen.ids[i] = c.light, probability[i] = c.probability;
        });
        return chosen;
    }
    if (lights.pick.can_remap()) {
        const Discrete::RemappedLanes chosen = lights.pick.sample_remapped(u.x);
        return {.ids = chosen.index, .u = {chosen.u, u.y}};
    }
    const Float8 number = address.get1(v.path.sample);
    std::array<double, float_lanes> numbers;
    for (uint32_t i = 0; i < float_lanes; ++i) numbers[i] = extend_precision(number[i], Vec2{u.x[i], u.y[i]});
    ChosenLights chosen{.u = u};
    if (!lights.tree) {
        for (uint32_t i = 0; i < float_lanes; ++i) chosen.ids[i] = lights.pick.sample(numbers[i]);
        return chosen;
    }
    const auto choices = choose_by_tree(lights, v.origin, v.ns, numbers, active);
    Float8& probability = chosen.probability.emplace();
    for (uint32_t i = 0; i < float_lanes; ++i)
        chosen.ids[i] = choices[i].light, probability[i] = choices[i].probability;
    return chosen;
}

// View::sample_light() for lights of several kinds. Lanes with lights of one kind are sampled together, the others one
// by one.
template <Shading shading>
inline void WideBatch<shading>::sample_any_light(const Vertices& v, const ChosenLights& chosen, LightQuery& query)
{
    using LightKind = WideScene::LightKind;
    const Scene& scene = view_.scene;
    const Float8* const choice = chosen.choice();
    LightSampleLanes& s = query.light;
    uint32_t through = 0, one_by_one = query.active, done = 0;
    if constexpr (any) through = v.non_lambert.transmits;
    if (choice) one_by_one &= movemask(*choice > Float8{});
    const auto choosing = [&](LightKind kind) {
        uint32_t lanes = 0;
        for (uint32_t i = 0; i < float_lanes; ++i) lanes |= uint32_t{scene_.light_kinds[chosen.ids[i]] == kind} << i;
        return lanes & one_by_one;
    };
    // Lights behind a transmissive surface are left to the scalar functions.
    const auto sample_kind = [&](uint32_t lanes, bool is_sphere) {
        if (lanes == 0) return;
        const auto sample = [&](LightSampleLanes& to) {
            if (is_sphere)
                sample_sphere_lights(scene_, chosen.ids, v.origin, chosen.u, choice, to), lanes &= movemask(to.found);
            else
                sample_triangles(scene_, chosen.ids, v.origin, chosen.u, choice, to);
            to.found &= ~(dot(to.wi, v.n) <= Float8{}) & lanes_of(lanes);
        };
        if (done == 0) {
            sample(s);
        } else {
            LightSampleLanes more;
            sample(more);
            s = select(lanes_of(lanes), more, s);
        }
        done |= lanes;
    };
    if (!scene_.sphere_lights.empty()) sample_kind(choosing(LightKind::sphere) & ~through, true);
    if (!scene_.lights.empty()) sample_kind(choosing(LightKind::triangle) & ~through, false);
    if (done == 0) s = LightSampleLanes{};
    if (const uint32_t lanes = samples_sky_ ? choosing(LightKind::constant_environment) : 0; lanes != 0) {
        sample_constant_environment(v, chosen, lanes, s);
        done |= lanes;
    }
    one_by_one &= ~done;
    if (one_by_one == 0) return;
    uint32_t found = movemask(s.found), infinite = movemask(s.infinite), delta = 0;
    Surface from{};
    for_each_lane(one_by_one, [&](uint32_t i) {
        const uint32_t bit = 1u << i, id = chosen.ids[i];
        from.n = from.side = lane(v.n, i), from.ns = lane(v.ns, i), from.origin = lane(v.origin, i);
        if constexpr (any) from.p = lane(v.non_lambert.p, i), from.p_error = lane(v.non_lambert.p_error, i);
        const bool both_sides = (through & bit) != 0;
        const auto light = sample_given_light(scene, from, id, {chosen.u.x[i], chosen.u.y[i]}, both_sides);
        if (!light) return;
        const Color& radiance = light->radiance;
        set_lane(s.wi, i, light->wi), set_lane(s.point, i, light->point), set_lane(s.p_error, i, light->p_error);
        set_lane(s.n, i, light->n), set_lane(s.radiance, i, {radiance.r, radiance.g, radiance.b});
        s.pdf[i] = light->pdf * (choice ? (*choice)[i] : scene.lights.pick.probability(id));
        found |= bit;
        if (light->infinite) infinite |= bit;
        if (light->delta) delta |= bit;
    });
    s.found = lanes_of(found), s.infinite = lanes_of(infinite), s.delta = lanes_of(delta);
}

// View::sample_light()
template <Shading shading>
inline void WideBatch<shading>::sample_light(const Vertices& v, const AddressLanes& address, const Vec2x8& u,
                                             LightQuery& query)
{
    const ChosenLights chosen = choose_lights(v, query.active, address, u);
    bool of_kinds = textured && !scene_.has_triangles_only;
    if constexpr (any) of_kinds |= (query.active & v.non_lambert.transmits) != 0;
    if constexpr (textured)
        if (of_kinds) return sample_any_light(v, chosen, query);
    sample_triangles(scene_, chosen.ids, v.origin, chosen.u, chosen.choice(), query.light);
}

// Lanes for which light is sampled; see samples_light().
template <Shading shading>
inline uint32_t WideBatch<shading>::light_sampling_lanes(const Vertices& v) const
{
    const Float8 zero{};
    uint32_t active = samples_on_matt_ ? v.hit & movemask((v.cos_o > zero) & ~is_black(v.albedo)) : 0;
    if constexpr (!any) return path_.parts.has(segment_after(segment(), false)) ? active : 0;
    if constexpr (any) {
        active |= v.hit & v.non_lambert.lanes & ~v.non_lambert.only_delta & movemask(v.cos_o > zero);
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
    query.active = light_sampling_lanes(v);
    if (learned_) query.active = lanes_by_rate(query.active, v);
    if (query.active == 0) return;
    const AddressLanes address = numbers(v.path.key, depth_, Dim::light);
    const Vec2x8 u = address.get2(v.path.sample);
    sample_light(v, address, u, query);
    if (learned_) query.light.pdf *= v.light_rate;
    if constexpr (any) {
        const uint32_t non_lambert = query.active & v.non_lambert.lanes & movemask(query.light.found);
        if (non_lambert == 0) return;
        query.wi = FrameT<Float8>(v.ns).to_local(query.light.wi);
        if ((non_lambert & v.non_lambert.plastic.lanes) != 0)
            non_lambert_.plastic.put_wi(v.non_lambert.plastic, query.wi);
    }
}

// Evaluates the BSDFs that are not Lambertian.
template <Shading shading>
inline void WideBatch<shading>::eval_non_lambert(const Vertices& v, const LightQuery& query, uint32_t lanes,
                                                 Vec3x8& f_cos, Float8& pdf) const
{
    const Float8 zero{};
    const Mask8 disagree = ~sides_agree(v.n, query.light.wi, query.wi.z);
    const uint32_t plastic = lanes & v.non_lambert.plastic.lanes;
    if (plastic != 0) {
        const BsdfValueLanes f = non_lambert_.plastic.value(v.non_lambert.plastic);
        const Mask8 is_asked = lanes_of(plastic);
        f_cos = select(is_asked, select(disagree, {zero, zero, zero}, f.f_cos), f_cos);
        pdf = select(is_asked, select(disagree, zero, f.pdf), pdf);
    }
    for_each_lane(lanes & ~plastic, [&](uint32_t i) {
        BsdfValue f{};
        if ((movemask(disagree) >> i & 1) == 0)
            f = std::visit([&](const auto& bsdf) { return bsdf.eval(lane(v.non_lambert.wo, i), lane(query.wi, i)); },
                           *v.non_lambert.bsdf[i]);
        set_lane(f_cos, i, {f.f_cos.r, f.f_cos.g, f.f_cos.b});
        pdf[i] = f.pdf;
    });
}

template <Shading shading>
inline void WideBatch<shading>::sample_direct(std::span<Vertices> vertices)
{
    if constexpr (any) {
        for (size_t i = 0; i < vertices.size(); ++i) query_light(vertices[i], non_lambert_.query[i]);
        non_lambert_.plastic.eval();
        for (size_t i = 0; i < vertices.size(); ++i) send_shadows(vertices[i], non_lambert_.query[i]);
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
        if (view_.scene.passes_sheets) {
            const uint32_t through = sent & movemask(light.delta);
            send_through_sheets(v, through, to, origin, dir, distance, radiance);
            sent &= ~through;
        }
    shadows_.push(sent, origin, dir, distance, {radiance, v.path.slot});
    set_alpha_keys(shadows_, sent, v.path, depth_, Dim::shadow_alpha);
}

// Requests shadow rays that thin sheets of smooth glass do not stop.
template <Shading shading>
inline void WideBatch<shading>::send_through_sheets(const Vertices& v, uint32_t lanes, const LightQuery& query,
                                                    const Vec3x8& origin, const Vec3x8& dir, const Float8& distance,
                                                    const Vec3x8& radiance)
{
    const AddressLanes address = numbers(v.path.key, depth_, Dim::shadow_alpha);
    const auto color = [](Vec3 c) { return Color{c.x, c.y, c.z}; };
    for_each_lane(lanes, [&](uint32_t i) {
        Ray ray{.org = lane(origin, i), .dir = lane(dir, i), .t_max = distance[i]};
        if (view_.scene.geometry.alpha_test.passes_through) ray.key = address.key(i, v.path.sample[i]);
        PathActions(w_.queue, v.path.slot[i])
            .tinted_shadow(ray, color(lane(radiance, i)), color(lane(query.light.radiance, i)));
    });
}

template <Shading shading>
inline void WideBatch<shading>::add_unoccluded()
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

}  // namespace lancer
