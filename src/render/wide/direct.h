// What vertices of a WideBatch get from lamps: emission met by their rays, and light that is sampled.
#pragma once

#include "render/wide/batch.h"
#include "scene/environment/constant.h"

namespace lancer {

// What the functions for one path want of it where ray i ended.
template <Shading shading>
inline State WideBatch<shading>::state_of(size_t i, const Lanes& path, uint32_t in) const
{
    State s;
    const Vec3 t = lane(path.throughput, in);
    s.ray = now_.rays()[i];
    s.throughput = {t.x, t.y, t.z};
    s.pdf = path.pdf[in];
    if constexpr (looks_up) s.cone = {path.width[in], path.spread[in]};
    if (keeps_normals_ && depth_ > 0) s.normal = w_.wide.normals_now[i];
    if constexpr (any) {
        const uint32_t so_far = path.so_far[in];
        s.specular = (so_far & was_specular) != 0;
        s.light_sampled = (so_far & has_sampled_light) != 0;
        s.leg = leg_of(path.so_far, in);
    } else {
        s.specular = depth_ == 0;
        s.light_sampled = samples_ && depth_ > 0;
        s.leg = leg();
    }
    return s;
}

template <Shading shading>
inline void WideBatch<shading>::add_emission(size_t i, const Lanes& path, uint32_t in)
{
    const State s = state_of(i, path, in);
    Steps steps(w_.queue, path.slot[in]);
    lancer::add_emission(view_, s, view_.surface_at(s.ray, w_.hits[i], s.cone), path_.direct, path_.parts, steps);
}

// To lanes whose rays met nothing; `first`: the ray of the first lane.
template <Shading shading>
inline void WideBatch<shading>::add_sky(uint32_t missed, size_t first, const Lanes& path)
{
    if (missed == 0) return;
    if constexpr (any) {
        if (!path_.parts.has_all())
            for_bits(missed, [&](uint32_t i) { missed &= ~(uint32_t{!path_.parts.has(leg_of(path.so_far, i))} << i); });
    } else if (!path_.parts.has(leg())) {
        return;
    }
    uint32_t plain = missed;  // of which nothing needs to be weighed
    if constexpr (looks_up) {
        if (!view_.scene.has_even_sky())
            plain = 0;
        else if constexpr (any)
            plain &= ~bits(is_set(path.so_far, has_sampled_light));
        else if (samples_sky_)
            plain = 0;
    }
    const Color sky = view_.scene.environment;
    if (!is_black(sky))
        for_bits(plain, [&](uint32_t i) {
            const Vec3 t = lane(path.throughput, i);
            Steps(w_.queue, path.slot[i]).add(Color{t.x, t.y, t.z} * sky);
        });
    for_bits(missed & ~plain, [&](uint32_t i) {
        Steps steps(w_.queue, path.slot[i]);
        add_environment(view_, state_of(first + i, path, i), path_.direct, path_.parts, steps);
    });
}

// Rays of which only emission counts where they end, and no surface shines: what they meet is not asked for.
template <Shading shading>
inline void WideBatch<shading>::end_in_sky()
{
    w_.occluded.resize(now_.size());
    accel_.any(now_.rays(), w_.occluded);
    for (size_t first = 0; first < now_.size(); first += float_lanes) {
        Lanes path;
        now_.load(first, path);
        uint32_t missed = 0;
        for (size_t i = 0; i < std::min<size_t>(float_lanes, now_.size() - first); ++i)
            missed |= (w_.occluded[first + i] ? 0u : 1u) << i;
        add_sky(missed, first, path);
    }
}

// A direction to a sky of one colour, for some lanes.
template <Shading shading>
inline void WideBatch<shading>::add_even_sky(const Vertices& v, const Vec2x8& u, uint32_t lanes,
                                             LightSampleLanes& s) const
{
    const Scene& scene = view_.scene;
    const Float8 zero{};
    const Mask8 here = lanes_of(lanes);
    const ConstantEnvironmentSample<Float8> sample(v.ns, u.x, u.y);
    const Color& c = scene.environment;
    s.wi = select(here, sample.wi, s.wi);
    s.pdf = select(here, sample.pdf * scene.lights.pick.probability(scene.environment_light), s.pdf);
    s.radiance = select(here, {all_lanes(c.r), all_lanes(c.g), all_lanes(c.b)}, s.radiance);
    s.found |= here & (sample.pdf > zero) & (dot(sample.wi, v.n) > zero);
    s.infinite |= here;
}

// Where lights are few, a part of the first number of the point chooses; else one of their own.
template <Shading shading>
inline typename WideBatch<shading>::Lamps WideBatch<shading>::choose_lamps(const Vertices& v, uint32_t asking,
                                                                           const AddressLanes& address,
                                                                           const Vec2x8& u) const
{
    const LightTable& lights = view_.scene.lights;
    if (lights.pick.stretches()) {
        const Discrete::StretchedLanes chosen = lights.pick.stretch(u.x);
        return {.ids = chosen.index, .u = {chosen.u, u.y}};
    }
    const Float8 number = address.get1(v.path.sample);
    std::array<double, float_lanes> numbers;
    for (uint32_t i = 0; i < float_lanes; ++i) numbers[i] = lengthened(number[i], Vec2{u.x[i], u.y[i]});
    Lamps lamps{.u = u};
    if (!lights.tree) {
        for (uint32_t i = 0; i < float_lanes; ++i) lamps.ids[i] = lights.pick.sample(numbers[i]);
        return lamps;
    }
    const auto choices = choose_by_tree(lights, v.origin, v.ns, numbers, asking);
    Float8& probability = lamps.probability.emplace();
    for (uint32_t i = 0; i < float_lanes; ++i) lamps.ids[i] = choices[i].light, probability[i] = choices[i].probability;
    return lamps;
}

// View::sample_light() where lights are of several kinds. Lanes that choose lights of the same kind sample them
// together; the others go one after the other.
template <Shading shading>
inline void WideBatch<shading>::sample_any_light(const Vertices& v, const Lamps& lamps, Lit& lit)
{
    using Lamp = WideScene::Lamp;
    const Scene& scene = view_.scene;
    const Float8* const choice = lamps.choice();
    LightSampleLanes& s = lit.light;
    uint32_t through = 0, one_by_one = lit.asking, done = 0;
    if constexpr (any) through = v.others.transmits;
    if (choice) one_by_one &= bits(*choice > Float8{});
    const auto choosing = [&](Lamp lamp) {
        uint32_t lanes = 0;
        for (uint32_t i = 0; i < float_lanes; ++i) lanes |= uint32_t{scene_.lamps[lamps.ids[i]] == lamp} << i;
        return lanes & one_by_one;
    };
    // What lies behind a surface that lets light through is for the others.
    const auto take_lamps = [&](uint32_t lanes, bool is_ball) {
        if (lanes == 0) return;
        const auto sample = [&](LightSampleLanes& to) {
            if (is_ball)
                sample_balls(scene_, lamps.ids, v.origin, lamps.u, choice, to), lanes &= bits(to.found);
            else
                sample_triangles(scene_, lamps.ids, v.origin, lamps.u, choice, to);
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
    if (!scene_.balls.empty()) take_lamps(choosing(Lamp::ball) & ~through, true);
    if (!scene_.lights.empty()) take_lamps(choosing(Lamp::triangle) & ~through, false);
    if (done == 0) s = LightSampleLanes{};
    if (const uint32_t lanes = samples_sky_ ? choosing(Lamp::even_sky) : 0; lanes != 0) {
        add_even_sky(v, lamps.u, lanes, s);
        done |= lanes;
    }
    one_by_one &= ~done;
    if (one_by_one == 0) return;
    uint32_t found = bits(s.found), infinite = bits(s.infinite), delta = 0;
    Surface from{};
    for_bits(one_by_one, [&](uint32_t i) {
        const uint32_t bit = 1u << i, id = lamps.ids[i];
        from.n = from.side = lane(v.n, i), from.ns = lane(v.ns, i), from.origin = lane(v.origin, i);
        if constexpr (any) from.p = lane(v.others.p, i), from.p_error = lane(v.others.p_error, i);
        const bool both_sides = (through & bit) != 0;
        const auto light = sample_given_light(scene, from, id, {lamps.u.x[i], lamps.u.y[i]}, both_sides);
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
inline void WideBatch<shading>::sample_light(const Vertices& v, const AddressLanes& address, const Vec2x8& u, Lit& lit)
{
    const Lamps lamps = choose_lamps(v, lit.asking, address, u);
    bool of_kinds = looks_up && !scene_.has_triangles_only;
    if constexpr (any) of_kinds |= (lit.asking & v.others.transmits) != 0;
    if constexpr (looks_up)
        if (of_kinds) return sample_any_light(v, lamps, lit);
    sample_triangles(scene_, lamps.ids, v.origin, lamps.u, lamps.choice(), lit.light);
}

// Lanes in which light is sampled. See samples_light(); where nothing goes back along the path, none is.
template <Shading shading>
inline uint32_t WideBatch<shading>::asks_for_light(const Vertices& v) const
{
    const Float8 zero{};
    uint32_t asking = samples_on_matt_ ? v.hit & bits((v.cos_o > zero) & ~is_black(v.albedo)) : 0;
    if constexpr (!any) return path_.parts.has(leg_after(leg(), false)) ? asking : 0;
    if constexpr (any) {
        asking |= v.hit & v.others.lanes & ~v.others.only_delta & bits(v.cos_o > zero);
        if (path_.parts.has_all()) return asking;
        for_bits(asking, [&](uint32_t i) {
            if (!path_.parts.has(leg_after(leg_of(v.path.so_far, i), false))) asking &= ~(1u << i);
        });
        return asking;
    }
}

template <Shading shading>
inline void WideBatch<shading>::ask_for_light(const Vertices& v, Lit& lit)
{
    lit.asking = asks_for_light(v);
    if (lit.asking == 0) return;
    const AddressLanes address = numbers(v.path.key, depth_, Dim::light);
    const Vec2x8 u = address.get2(v.path.sample);
    sample_light(v, address, u, lit);
    if constexpr (any) {
        const uint32_t others = lit.asking & v.others.lanes & bits(lit.light.found);
        if (others == 0) return;
        lit.wi = FrameT<Float8>(v.ns).to_local(lit.light.wi);
        if ((others & v.others.plastic.lanes) != 0) others_.plastic.put_wi(v.others.plastic, lit.wi);
    }
}

// What lanes whose surfaces are not matt do to the light.
template <Shading shading>
inline void WideBatch<shading>::eval_others(const Vertices& v, const Lit& lit, uint32_t lanes, Vec3x8& f_cos,
                                            Float8& pdf) const
{
    const Float8 zero{};
    const Mask8 disagree = ~sides_agree(v.n, lit.light.wi, lit.wi.z);
    const uint32_t plastic = lanes & v.others.plastic.lanes;
    if (plastic != 0) {
        const BsdfValueLanes f = others_.plastic.value(v.others.plastic);
        const Mask8 is_asked = lanes_of(plastic);
        f_cos = select(is_asked, select(disagree, {zero, zero, zero}, f.f_cos), f_cos);
        pdf = select(is_asked, select(disagree, zero, f.pdf), pdf);
    }
    for_bits(lanes & ~plastic, [&](uint32_t i) {
        BsdfValue f{};
        if ((bits(disagree) >> i & 1) == 0)
            f = std::visit([&](const auto& bsdf) { return bsdf.eval(lane(v.others.wo, i), lane(lit.wi, i)); },
                           *v.others.bsdf[i]);
        set_lane(f_cos, i, {f.f_cos.r, f.f_cos.g, f.f_cos.b});
        pdf[i] = f.pdf;
    });
}

template <Shading shading>
inline void WideBatch<shading>::sample_direct(std::span<const Vertices> vertices)
{
    if constexpr (any) {
        for (size_t i = 0; i < vertices.size(); ++i) ask_for_light(vertices[i], others_.lit[i]);
        others_.plastic.eval();
        for (size_t i = 0; i < vertices.size(); ++i) send_shadows(vertices[i], others_.lit[i]);
    } else {
        for (const Vertices& v : vertices) {
            Lit lit;
            ask_for_light(v, lit);
            send_shadows(v, lit);
        }
    }
}

// Rays that find out what of the light arrives.
template <Shading shading>
inline void WideBatch<shading>::send_shadows(const Vertices& v, const Lit& to)
{
    if (to.asking == 0) return;
    const LightSampleLanes& light = to.light;
    const Float8 zero{}, cos_i = dot(light.wi, v.ns);
    auto [f_cos, pdf] = lambert_value(v.albedo, cos_i);
    Mask8 lit = light.found & (dot(light.wi, v.n) > zero) & (cos_i > zero);
    if constexpr (any) {
        const uint32_t others = to.asking & v.others.lanes & bits(light.found);
        if (others != 0) {
            eval_others(v, to, others, f_cos, pdf);
            lit |= lanes_of(others);
        }
    }
    lit &= lanes_of(to.asking) & ~is_black(f_cos);
    if (bits(lit) == 0) return;
    const Float8 weight = weight_of_light_sample(light.pdf, pdf, looks_up ? light.delta : Mask8{}, path_.direct);
    const Vec3x8 radiance = sampled_light(v.path.throughput, f_cos, light.radiance, weight / light.pdf);
    const uint32_t wanted = bits(lit & ~is_black(radiance));
    if (wanted == 0) return;
    Vec3x8 origin = v.origin;
    if constexpr (any)
        for_bits(wanted & v.others.lanes & bits(dot(light.wi, v.n) < zero),
                 [&](uint32_t i) { set_lane(origin, i, origin_behind(v, i)); });
    auto [dir, distance] = ShadowSegment<Float8>(origin, light);
    if constexpr (looks_up) {
        dir = select(light.infinite, light.wi, dir);
        distance = select(light.infinite, all_lanes(std::numeric_limits<float>::infinity()), distance);
    }
    const uint32_t traceable = bits(is_traceable(origin, dir, all_lanes(Ray{}.t_min), distance));
    spoil(wanted & ~traceable, v.path.slot);
    shadows_.push(wanted & traceable, origin, dir, distance, {radiance, v.path.slot});
    give_keys(shadows_, wanted & traceable, v.path, depth_, Dim::shadow_hole);
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
