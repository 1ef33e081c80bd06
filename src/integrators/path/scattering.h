// Paths in media that scatter: where on a ray, the light that arrives there, and where the path goes on. Distances
// follow the extinction of one colour channel, chosen by the throughput; all channels share the sample by the balance
// heuristic, so that none has a weight above 1 over its share: Wilkie et al., "Hero Wavelength Spectral Sampling",
// EGSR 2014; Pharr, Jakob, Humphreys, 4th ed., section 14.2.
#pragma once

#include "integrators/path/near_light.h"
#include "integrators/path/transport.h"
#include "scene/lights/choice.h"

namespace lancer {

// The density of distances along a flight.
class FlightDistance {
public:
    // throughput: not black.
    FlightDistance(const Flight& flight, Color throughput)
        : flight_(flight),
          extinction_(flight.medium->extinction()),
          share_(throughput / (throughput.r + throughput.g + throughput.b))
    {
    }
    // Where the medium scatters; infinity: not before the end of the flight.
    float sample(Vec2 u) const
    {
        const float of = u.y < share_.r ? extinction_.r : u.y < share_.r + share_.g ? extinction_.g : extinction_.b;
        const float t = of > 0 ? flight_.near - std::log1p(-u.x) / of : never;
        return t < flight_.far ? t : never;
    }
    // Density of scattering at t.
    float pdf(float t) const { return sum(share_ * extinction_ * left_at(t)); }
    // The part of the light that is scattered at t, per unit of length.
    Color scattered_at(float t) const { return flight_.medium->scattering * left_at(t); }
    // Weight of a path that reaches the end of the flight.
    Color beyond() const
    {
        const Color left = left_at(flight_.far);
        const float probability = sum(share_ * left);
        return probability > 0 ? left / probability : Color{};
    }
    static constexpr float never = std::numeric_limits<float>::infinity();

private:
    static float sum(Color c) { return c.r + c.g + c.b; }
    Color left_at(float t) const { return transmittance(*flight_.medium, t - flight_.near); }

    const Flight& flight_;
    Color extinction_, share_;
};

// A distance at which the path of s is scattered in this flight.
inline float sample_flight(const PathState& s, const Flight& flight, const Sampler& sampler)
{
    return FlightDistance(flight, s.throughput).sample(sampler.get2(s.depth, Dim::flight));
}

// How far before a surface a path must be scattered, so that rounding does not put it behind the surface.
inline float flight_margin(const Ray& ray, float t)
{
    return gamma(16) * (std::max({std::abs(ray.org.x), std::abs(ray.org.y), std::abs(ray.org.z)}) + t);
}

// Requests the shadow ray of a light sample from a place in the media of s. radiance: without what is on the way.
template <class V>
void send_to_light(const V& view, const PathState& s, Vec3 place, const LightSample& light, Color radiance,
                   uint32_t alpha_key, PathActions& actions)
{
    Ray ray = shadow_ray(place, light);
    ray.key = alpha_key;
    const bool tinted = needs_tint(view, light);
    if (!tinted) radiance *= transmittance_along(view.scene, s.media, ray.org, ray.dir, ray.t_max);
    actions.medium_shadow(ray, radiance, light, s.media, tinted);
}

// The light of a lamp near the ray, from a place that is chosen by the lamp; combined with next-event estimation where
// the path is scattered.
template <class V>
void sample_near_light(const V& view, const PathState& s, const Flight& flight, const FlightDistance& distance,
                       const Sampler& sampler, DirectLight how, PathActions& actions)
{
    const LightTable& table = view.scene.lights;
    if (table.pick.empty()) return;
    const Vec2 u = sampler.get2(s.depth, Dim::near_light);
    const uint32_t id = table.pick.size() == 1 ? 0 : table.pick.sample(double{u.x});
    const auto near = NearLight::of(view.scene, s.ray, flight, id);
    if (!near) return;
    const float t = near->sample(u.y);
    if (!(t > flight.near && t < flight.far)) return;
    const Vec3 place = s.ray.org + s.ray.dir * t;
    const auto light = sample_given_light_from(view.scene, place, id, sampler.get2(s.depth, Dim::along_the_ray));
    if (!light) return;
    const float chosen = probability_of(table, id, place, {}), phase = flight.medium->phase.eval(s.ray.dir, light->wi);
    const float own = table.pick.probability(id) * near->pdf(t);
    const float weight = power_heuristic(own, chosen * distance.pdf(t)) *
                         weight_of_light_sample(chosen * light->pdf, phase, light->delta, how) / (own * light->pdf);
    send_to_light(view, s, place, *light, s.throughput * distance.scattered_at(t) * light->radiance * (phase * weight),
                  view.alpha_key(sampler, s.depth, Dim::near_light), actions);
}

// Next-event estimation where a path is scattered. throughput: there.
template <class V>
void sample_direct_in_medium(const V& view, const PathState& s, const Flight& flight, const FlightDistance& distance,
                             float t, Vec3 place, Color throughput, const Sampler& sampler, DirectLight how,
                             PathActions& actions)
{
    const auto light = view.sample_light_in_medium(place, sampler, s.depth);
    if (!light) return;
    const float phase = flight.medium->phase.eval(s.ray.dir, light->wi);
    float weight = weight_of_light_sample(light->pdf, phase, light->delta, how);
    const LightTable& table = view.scene.lights;
    const auto near = how.near_lights ? NearLight::of(view.scene, s.ray, flight, light->light) : std::nullopt;
    if (near)
        weight *= power_heuristic(probability_of(table, light->light, place, {}) * distance.pdf(t),
                                  table.pick.probability(light->light) * near->pdf(t));
    send_to_light(view, s, place, *light, throughput * light->radiance * (phase * weight / light->pdf),
                  view.alpha_key(sampler, s.depth, Dim::shadow_alpha), actions);
}

// A flight of a path that is not `last` through a medium that scatters. t: sample_flight(), if that is before what the
// ray meets, else infinity: then the throughput of s becomes that at the end of the flight. is_last: as of
// trace_vertex().
template <class V, class IsLast>
void trace_flight(const V& view, PathState& s, const Flight& flight, float t, const Sampler& sampler, DirectLight how,
                  LightParts parts, uint32_t roulette_depth, const IsLast& is_last, PathActions& actions)
{
    const FlightDistance distance(flight, s.throughput);
    const bool samples = how.nee && !flight.medium->is_dark, counts = parts.has(segment_after(s.segment, false));
    if (samples && counts && how.near_lights) sample_near_light(view, s, flight, distance, sampler, how, actions);
    if (t == FlightDistance::never) {
        s.throughput *= distance.beyond();
        return;
    }
    const float pdf = distance.pdf(t);
    if (!(pdf > 0)) return;
    const Color throughput = s.throughput * distance.scattered_at(t) / pdf;
    if (is_black(throughput)) return;
    const Vec3 place = s.ray.org + s.ray.dir * t;
    if (samples && counts)
        sample_direct_in_medium(view, s, flight, distance, t, place, throughput, sampler, how, actions);
    actions.next_from(s, [&](PathState& n) {
        const Vec3 wi = flight.medium->phase.sample(s.ray.dir, sampler.get2(s.depth, Dim::bsdf));
        n.ray = {.org = place, .dir = wi};
        view.set_alpha_key(n.ray, sampler, s.depth + 1, Dim::alpha);
        n.throughput = throughput;
        n.pdf = flight.medium->phase.eval(s.ray.dir, wi);
        n.normal = {};
        n.specular = false;
        n.segment = segment_after(s.segment, false);
        n.cone = {s.cone.width + s.cone.spread * t, opened(s.cone.spread, n.pdf)};
        n.mirror_distance = 0;
        ++n.depth;
        if (!survives_roulette(n, sampler, roulette_depth, view.plan.split)) return false;
        n.light_sampled = samples;
        n.last = is_last(n) || (n.segment == PathSegment::direct && !parts.indirect);
        return true;
    });
}

}  // namespace lancer
