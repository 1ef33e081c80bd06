// Flights of the paths of a batch through media that scatter. Where the medium scatters is chosen before rays are
// traced. In dense media a ray then ends there, so that walks of hundreds of steps inside a body cost short rays alone.
#pragma once

#include "integrators/path/scattering.h"
#include "integrators/view.h"
#include "render/workspace.h"

namespace lancer {

// An integrator that follows what media scatter; for others the scene has none that do.
template <class Integrator>
concept Flies = requires(const Integrator i, const View v, PathState s, const Flight f, const Sampler r, PathActions a)
{
    i.fly(v, s, f, 1.0f, r, a);
};

// Fills w.flights for w.states, and ends the rays in dense media. Those of the camera go on to the first surface, which
// AOVs are of.
template <class SamplerOf>
void sample_flights(const View& view, const SamplerOf& sampler, Workspace& w)
{
    w.flights.assign(w.states.size(), FlightDistance::never);
    for (size_t i = 0; i < w.states.size(); ++i) {
        const PathState& s = w.states[i];
        const Flight flight = flight_along(view.scene, s.media, s.ray.org, s.ray.dir, FlightDistance::never);
        if (s.last || !flight.scatters()) continue;
        const float t = sample_flight(s, flight, sampler(s.slot, s.sample, s.branch));
        w.flights[i] = t;
        if (flight.medium->is_dense && s.depth > 0 && t < FlightDistance::never)
            w.rays[i].t_max = t + flight_margin(s.ray, t);
    }
}

enum class Flown { nowhere, to_its_end, scattered };

// The flight of a path that is not `last`, to the surface that its ray met, or none. t: of w.flights. nowhere: nothing
// scatters on the way.
template <class V, class Integrator, class Listener>
Flown fly(const V& view, const Integrator& integrator, PathState& s, float t, const Surface* end,
          const Sampler& sampler, const Queue& queue, PathActions& actions, const Listener& listener)
{
    const Flight flight = flight_along(view.scene, s.media, s.ray.org, s.ray.dir, end ? end->t : FlightDistance::never);
    if (!flight.scatters()) return Flown::nowhere;
    const bool is_scattered = t < FlightDistance::never && !(end && end->t <= t + flight_margin(s.ray, t));
    if (is_scattered) listener.scattered(s, t, *flight.medium, end);
    const QueueSizes queued(queue);
    integrator.fly(view, s, flight, is_scattered ? t : FlightDistance::never, sampler, actions);
    listener.left_medium(s, queued);
    return is_scattered ? Flown::scattered : Flown::to_its_end;
}

}  // namespace lancer
