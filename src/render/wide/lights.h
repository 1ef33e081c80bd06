// Which light a WideBatch samples at its vertices, and where on it.
#pragma once

#include "render/wide/batch.h"
#include "scene/environment/constant.h"

namespace lancer {

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
inline typename WideBatch<shading>::ChosenLights WideBatch<shading>::choose_lights(const Vertices& v,
                                                                                   const LightQuery& query,
                                                                                   const AddressLanes& address,
                                                                                   const Vec2x8& u) const
{
    const LightTable& lights = view_.scene.lights;
    if (query.by_place) {
        const LightChoice& choice = view_.plan.light_choice;
        const Float8 number = address.get1(v.path.sample);
        ChosenLights chosen{.u = u};
        Float8& probability = chosen.probability.emplace();
        for_each_lane(query.active, [&](uint32_t i) {
            const LightChoice::Chosen c = choice.choose(v.light_cell[i], number[i]);
            chosen.options[i] = c.option, probability[i] = c.probability;
            if (choice.is_tile(c.option))
                chosen.tiles |= 1u << i;
            else
                chosen.ids[i] = c.option;
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
    const auto choices = choose_by_tree(lights, v.origin, v.ns, numbers, query.active);
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
        return lanes & one_by_one & ~chosen.tiles;
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
    if (const uint32_t lanes = samples_sky_ && !tiles_ ? choosing(LightKind::constant_environment) : 0; lanes != 0) {
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
        const Vec2 u{chosen.u.x[i], chosen.u.y[i]};
        std::optional<LightSample> light;
        if (query.by_place) {
            light = view_.sample_option(from, chosen.options[i], (*choice)[i], u, both_sides, v.light_cell[i]);
        } else {
            light = sample_given_light(scene, from, id, u, both_sides);
            if (light) light->pdf *= choice ? (*choice)[i] : scene.lights.pick.probability(id);
        }
        if (!light) return;
        const Color& radiance = light->radiance;
        set_lane(s.wi, i, light->wi), set_lane(s.point, i, light->point), set_lane(s.p_error, i, light->p_error);
        set_lane(s.n, i, light->n), set_lane(s.radiance, i, {radiance.r, radiance.g, radiance.b});
        s.pdf[i] = light->pdf;
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
    const ChosenLights chosen = choose_lights(v, query, address, u);
    query.ids = chosen.ids;
    bool of_kinds = textured && (tiles_ || !scene_.has_triangles_only);
    if constexpr (any) of_kinds |= (query.active & v.non_lambert.transmits) != 0;
    if constexpr (textured)
        if (of_kinds) return sample_any_light(v, chosen, query);
    sample_triangles(scene_, chosen.ids, v.origin, chosen.u, chosen.choice(), query.light);
}

}  // namespace lancer
