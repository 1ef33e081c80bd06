#include "reference/walk.h"

#include <algorithm>

#include "reference/scattering_media.h"

namespace reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// What a boundary parts: the media on either side, and the ratio of their indices where they tell (else 0).
struct Sides {
    Inside here, beyond;
    double index = 0;
    bool is_there = true;
};

Sides sides_of(const World& world, const Inside& in, const Surface& s)
{
    Sides sides{in, in};
    const Material& m = world.materials[s.material];
    if (!m.bounds_medium()) return sides;
    if (s.front)
        sides.beyond.enter(s.material);
    else if (!sides.beyond.leave(s.material))
        sides.here.had_been_entered(s.material);
    if (!m.what.priority) {
        sides.is_there = !m.is_bare();
        return sides;
    }
    const Inside::There before = sides.here.there(world), after = sides.beyond.there(world);
    sides.index = after.index / before.index;
    sides.is_there = before.material != after.material && !(m.is_bare() && sides.index == 1);
    return sides;
}

// What is left of the light that comes straight along a ray from t_max: nothing if anything stops it, by chance of what
// has holes; what is not there does not.
Rgb left_of_light(const World& world, Ray ray, Shape left, double t_max, Inside in, Random& random)
{
    Rgb part{1, 1, 1};
    for (Hit hit; (hit = closest(world, ray, left, t_max));) {
        const Surface s = surface_at(world, ray, hit);
        const Sides sides = sides_of(world, in, s);
        part = part * transmittance(along(world, sides.here, ray, hit.t));
        const bool has_hole = world.materials[s.material].has_holes() && random.next() >= opacity(world, s);
        const bool passes = !sides.is_there && world.has_bare();
        if (!has_hole && !passes) return {};
        ray.org = s.p, left = hit.shape, t_max -= hit.t, in = sides.beyond;
    }
    return part * transmittance(along(world, in, ray, t_max));
}

// Towards wi, of what is behind the surface or in front of it.
const Inside& on_side(const Surface& s, Vec wi, const Inside& here, const Inside& beyond)
{
    return dot(wi, s.n) < 0 ? beyond : here;
}

// The sides must be those of the surface itself, or a tilted normal would carry light through it.
bool sides_agree(const Surface& s, Vec wi, Vec local) { return (dot(wi, s.n) < 0) == (local.z < 0); }

// add(direction, distance, irradiance) for each light that no ray meets.
template <class Add>
void for_points(const World& world, Vec place, const Add& add)
{
    for (const World::Point& l : world.points) {
        const Vec way = l.at - place;
        const double distance = norm(way);
        add(way * (1 / distance), distance, l.intensity_towards(way * (-1 / distance)) * (1 / (distance * distance)));
    }
    for (const World::Directional& l : world.directionals) add(l.towards, infinity, l.irradiance);
}

Rgb light_of_points(const World& world, const Surface& s, const Basis& frame, Vec wo, const Bsdf& bsdf,
                    const Inside& here, const Inside& beyond, Random& random)
{
    Rgb sum;
    const auto add = [&](Vec wi, double distance, Rgb irradiance) {
        const Vec local = frame.to_local(wi);
        if (!sides_agree(s, wi, local)) return;
        const Rgb f = bsdf.eval(wo, local);
        if (!black(f))
            sum += f * irradiance *
                   left_of_light(world, {s.p, wi}, s.shape, distance, on_side(s, wi, here, beyond), random);
    };
    for_points(world, s.p, add);
    return sum;
}

// At a place in a medium, to which a ray came along `dir`.
Rgb scattered_light_of_points(const World& world, Vec place, Vec dir, const Within& medium, const Inside& in,
                              Random& random)
{
    Rgb sum;
    for_points(world, place, [&](Vec wi, double distance, Rgb irradiance) {
        sum += henyey_greenstein(medium.g, dot(dir, wi)) * irradiance *
               left_of_light(world, {place, wi}, {}, distance, in, random);
    });
    return sum;
}

// Russian roulette: Arvo and Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990.
bool survives(Rgb& throughput, double index2, uint32_t depth, Random& random)
{
    if (depth < 8) return true;
    const double survival = std::min(0.97, largest(throughput) * index2);
    if (!(random.next() < survival)) return false;
    throughput = throughput * (1 / survival);
    return true;
}

}  // namespace

Rgb walk(const World& world, Ray ray, const WalkSettings& settings, Random& random)
{
    Rgb light, throughput{1, 1, 1};
    Inside in;
    if (world.camera_medium) in.enter(*world.camera_medium);
    Shape left;
    uint32_t depth = 0;
    bool is_view = true, is_sharp = true, is_last = false;
    double index2 = 1;  // of all refractions: throughput times it speaks of energy
    for (;;) {
        const Hit hit = closest(world, ray, left);
        const Within medium = along(world, in, ray, hit.t);
        if (const std::optional<double> t = track(medium, throughput, random)) {
            if (is_last || black(throughput)) return light;
            const Vec place = ray.org + ray.dir * *t;
            if (is_view || settings.indirect)
                light += throughput * scattered_light_of_points(world, place, ray.dir, medium, in, random);
            ray = {place, deflected(medium.g, ray.dir, random)}, left = {};
            is_last = ++depth == settings.max_depth || (is_view && !settings.indirect);
            is_view = is_sharp = false;
            if (!survives(throughput, index2, depth, random)) return light;
            continue;
        }
        if (!hit) return light + throughput * world.sky(ray.dir, is_sharp, ray.org);
        const Surface s = surface_at(world, ray, hit);
        left = hit.shape;
        if (world.materials[s.material].has_holes() && random.next() >= opacity(world, s)) {
            ray.org = s.p;
            continue;
        }
        const Sides sides = sides_of(world, in, s);
        // A body that is left without having been entered was there all the way.
        if (in.there(world).material != sides.here.there(world).material)
            throughput = throughput * transmittance(along(world, sides.here, ray, hit.t));
        if (!sides.is_there) {
            ray.org = s.p, in = sides.beyond;
            is_sharp = is_sharp || !world.has_bare();
            continue;
        }
        light += throughput * emission(world, s);
        if (is_last) return light;

        const Bsdf bsdf = bsdf_at(world, s, sides.index, random);
        const Basis frame(s.ns);
        const Vec wo = frame.to_local(-ray.dir);
        if (!bsdf.only_delta() && (is_view || settings.indirect))
            light += throughput * light_of_points(world, s, frame, wo, bsdf, sides.here, sides.beyond, random);
        const std::optional<Scattered> next = bsdf.sample(wo, random);
        if (!next || black(next->weight)) return light;
        const Vec wi = unit(frame.to_world(next->wi));
        if (!sides_agree(s, wi, next->wi)) return light;
        throughput = throughput * next->weight;
        index2 *= next->index * next->index;
        // Only what is no mirror is the end of what the camera sees.
        is_last = ++depth == settings.max_depth || (is_view && !next->delta && !settings.indirect);
        is_view = is_view && next->delta;
        is_sharp = next->delta;
        in = on_side(s, wi, sides.here, sides.beyond);
        ray = {s.p, wi};
        if (!survives(throughput, index2, depth, random)) return light;
    }
}

}  // namespace reference
