// Rows R of the stability matrix: rays that are hard or no rays at all.
#include <sys/wait.h>
#include <unistd.h>

#include <limits>

#include "stability/exact.h"
#include "stability/pictures.h"
#include "stability/ray_cases.h"
#include "support/agreement.h"
#include "support/ray_kinds.h"
#include "support/watertight.h"

namespace lancer::stability {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

Geometry of_mesh(Mesh mesh)
{
    Geometry g;
    g.meshes.push_back(std::move(mesh));
    return g;
}
// Two by two by two cubes with gaps between them, on coordinates that float holds.
Geometry cubes()
{
    Geometry g;
    for (int i = 0; i < 8; ++i)
        g.meshes.push_back(to_mesh(
            *make_cube(), make_transform({i & 1 ? 1.5 : -1.5, i & 2 ? 1.5 : -1.5, i & 4 ? 1.5 : -1.5}, {}, {1, 1, 1})));
    g.meshes.push_back(to_mesh(*make_uv_sphere(12, 24, 0.1), make_transform({}, {}, {0.5, 0.5, 0.5})));
    return g;
}

Outcome along_axes(const Setup& setup)
{
    const Geometry g = cubes();
    const DoubleTree reference(g);
    const auto accel = setup.make(g);
    Agreement closest, any;
    const size_t rays = setup.scaled(60000, 1000000, 10000000);
    for (size_t i = 0; i < rays; ++i) {
        AddressedRandom random(1, i);
        // One of the 26 patterns of signs that is not all zero; zeros of both signs.
        const auto pattern = static_cast<uint32_t>(i % 26 < 13 ? i % 26 : i % 26 + 1);
        const auto component = [&](uint32_t p) {
            const float zero = random.below(2) ? 0.0f : -0.0f;
            return p % 3 == 1 ? zero : static_cast<float>(p % 3) - 1;
        };
        const float x = component(pattern), y = component(pattern / 3);
        const Vec3 dir = normalize(Vec3{x, y, component(pattern / 9)});
        // On planes of the cubes' sides half of the time.
        const auto coordinate = [&] {
            const double side = random.below(8) * 0.5 - 2.5;
            return random.below(2) ? side : random.uniform(-3, 3);
        };
        const double ox = coordinate(), oy = coordinate();
        const Ray ray{.org = to_float(Vec3d{ox, oy, coordinate()}), .dir = dir};
        const Hit expected = reference.closest(ray), found = accel->closest(ray);
        closest.count(g, ray, i, expected, found);
        any.count_any(g, ray, i, expected, accel->any(ray), found);
    }
    Outcome out;
    const auto n = static_cast<double>(rays);
    out.measures = {
        at_most("wrong hits", static_cast<double>(closest.wrong), 0),
        at_most("wrong answers to whether anything is hit", static_cast<double>(any.wrong), 0),
        told("ties and edges, part of the rays", static_cast<double>(closest.ties + closest.explained) / n)};
    return out;
}

Outcome at_edges(const Setup& setup)
{
    const bool embree = setup.accelerator.starts_with("embree");
    std::map<std::string, double> misses, rays;
    const std::string far = ", where a grid of float is an eighth of an edge";
    const auto shoot = [&](Mesh mesh, const std::string& where = "") {
        const Geometry g = of_mesh(std::move(mesh));
        const auto accel = setup.make(g);
        const RaysFromInside from_inside(g.meshes[0], balls_inside(g, 4));
        const uint64_t count = setup.scaled(4000, 250000, 2500000);
        for (const Aim aim : aims)
            for (const Asked asked : all_asked) {
                const std::string name = std::string(name_of(aim)) + where;
                misses[name] += static_cast<double>(
                    count_misses(*accel, from_inside, aim, asked, static_cast<uint64_t>(asked) * count, count));
                rays[name] += static_cast<double>(count);
            }
    };
    const Mesh sphere = to_mesh(*make_uv_sphere(50, 100), make_transform({}, {}, {2, 2, 2}));
    shoot(sphere);
    shoot(moved(sphere, {148376, 1234, -223423}), far);
    shoot(to_mesh(*make_cube()));  // the diagonals of its sides: edges of two faces in one plane
    Outcome out;
    for (const auto& [aim, count] : rays) {
        const double per_million = 1e6 * misses[aim] / count;
        const std::string name = "leaks per million rays: " + aim;
        // Embree promises nothing at corners, and far away an edge is as good as one.
        const bool promised = !embree || aim.starts_with("random") || aim == "edge";
        out.measures.push_back(promised ? at_most(name, per_million, 0) : told(name, per_million));
    }
    return out;
}

// Conventions: the interval is closed at both ends, and what is seen exactly from its edge is not there. Embree asks
// its own distances whether they lie in it, which may be some ulps off.
Outcome ends_of_rays(const Setup& setup)
{
    std::map<std::string, double> wrong;
    const auto along = [](int axis, float a, float b, float c) {  // a along the axis, b and c across
        return axis == 0 ? Vec3{a, b, c} : axis == 1 ? Vec3{c, a, b} : Vec3{b, c, a};
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {1.0f, -1.0f})
            for (const float distance : {1.0f, 0.375f, 1024.0f}) {
                const float at = side * distance, s = 4 * distance;
                const Geometry g = of_mesh(
                    triangle_mesh(along(axis, at, -s, -s), along(axis, at, 2 * s, -s), along(axis, at, -s, 2 * s)));
                const auto accel = setup.make(g);
                const auto expect = [&](const char* what, Vec3 org, Vec3 dir, float t_min, float t_max, bool hit) {
                    const Ray ray{.org = org, .t_min = t_min, .dir = dir, .t_max = t_max};
                    std::array<Ray, 9> many;
                    many.fill(ray);
                    std::array<Hit, 9> hits;
                    std::array<uint8_t, 9> met;
                    accel->closest(many, hits, Coherence::coherent);
                    accel->any(many, met);
                    double& n = wrong[what];
                    n += static_cast<bool>(accel->closest(ray)) != hit || accel->any(ray) != hit;
                    for (size_t i = 0; i < many.size(); ++i)
                        n += static_cast<bool>(hits[i]) != hit || (met[i] != 0) != hit;
                };
                const float start = Ray{}.t_min, d = distance, below = std::nextafter(d, 0.0f),
                            above = std::nextafter(d, inf), clear = 4 * (above - d);
                const Vec3 ahead = along(axis, side, 0, 0), across = along(axis, 0, 1, 0);
                const char *ends = "ends that lie on it: hit", *beyond = "ends before or behind it: not hit";
                expect(ends, {}, ahead, start, inf, true);
                expect(ends, {}, ahead, start, d, true);
                expect(ends, {}, ahead, d, inf, true);
                expect(ends, {}, ahead, d, d, true);
                expect(beyond, {}, ahead, start, below, false);
                expect(beyond, {}, ahead, above, inf, false);
                expect(beyond, {}, -ahead, start, inf, false);
                const char *ends_near = "ends 4 ulps beyond it: hit", *beyond_clear = "ends 4 ulps before it: not hit";
                expect(ends_near, {}, ahead, start, d + clear, true);
                expect(ends_near, {}, ahead, d - clear, inf, true);
                expect(beyond_clear, {}, ahead, start, d - clear, false);
                expect(beyond_clear, {}, ahead, d + clear, inf, false);
                // From a place on it: rays as they are do not meet it, those that begin at 0 do.
                const Vec3 on = along(axis, at, 0, 0);
                expect("from a place on it: not hit", on, ahead, start, inf, false);
                expect("from a place on it: not hit", on, -ahead, start, inf, false);
                expect("from a place on it, beginning at 0: hit", on, ahead, 0, inf, true);
                const char* within = "within its plane: not hit";
                expect(within, on, across, start, inf, false);
                expect(within, along(axis, at, -3 * s, 0), across, start, inf, false);
                expect(within, along(axis, std::nextafter(at, 0.0f), -3 * s, 0), across, start, inf, false);
            }
    Outcome out;
    for (const auto& [what, count] : wrong) {
        const bool to_the_bit = what.starts_with("ends that") || what.starts_with("ends before");
        const std::string name = "wrong answers, " + what;
        out.measures.push_back(to_the_bit && setup.accelerator.starts_with("embree") ? told(name, count)
                                                                                     : at_most(name, count, 0));
    }
    return out;
}

Outcome odd_directions(const Setup& setup)
{
    const Geometry g = of_mesh(to_mesh(*make_uv_sphere(24, 48, 0.1)));
    const auto accel = setup.make(g);
    double wrong = 0, other = 0, rejected = 0, zero = 0, not_numbers = 0;
    const size_t rays = setup.scaled(300, 10000, 100000);
    const auto ask = [&](const Ray& ray) {
        const Hit hit = accel->closest(ray);
        accel->any(ray);
        not_numbers += hit && !std::isfinite(hit.t);
        return hit;
    };
    for (size_t i = 0; i < rays; ++i) {
        AddressedRandom random(1, i);
        const Vec3 org = to_float(random.direction() * 3.0);
        const Vec3d d = normalize(random.direction() - to_double(org) * 0.5);
        const Hit expected = accel->closest({.org = org, .dir = to_float(d)});
        for (int power = -30; power <= 18; ++power) {
            const Vec3d longer = d * std::pow(10.0, power);
            // Made unit, as everything here makes its rays, and as it is, which nothing promises.
            const Hit hit = ask({.org = org, .dir = to_float(normalize(longer))});
            wrong += static_cast<bool>(hit) != static_cast<bool>(expected) ||
                     (hit && ulps_between(static_cast<double>(hit.t), static_cast<double>(expected.t)) > 4);
            other += !same_primitive(ask({.org = org, .dir = to_float(longer)}), expected);
        }
        for (const Vec3 none : {Vec3{0, 0, 0}, Vec3{-0.0f, 0, -0.0f}, Vec3{-0.0f, -0.0f, -0.0f}}) {
            ++zero;
            rejected += !ask({.org = org, .dir = none}) && !accel->any({.org = org, .dir = none});
        }
        // A component that is no normal number is as good as 0.
        for (const float tiny : {1e-45f, -1e-42f, 1e-39f}) {
            const Hit axis = accel->closest({.org = {3, 0.01f, 0.02f}, .dir = {-1, 0, 0}});
            const Hit hit = ask({.org = {3, 0.01f, 0.02f}, .dir = {-1, tiny, -tiny}});
            wrong += !same_primitive(axis, hit);
            ask({.org = org, .dir = {tiny, 0, 0}});
            ask({.org = org, .dir = {tiny, -tiny, tiny}});
        }
    }
    Outcome out;
    out.measures = {exactly("rays of no direction that are rejected, of " + std::to_string(int(zero)), rejected, zero),
                    at_most("wrong hits of directions of length 1e-30 to 1e18 that were made unit", wrong, 0),
                    at_most("distances that are no numbers", not_numbers, 0),
                    told("other hits of directions that were not, part", other / (static_cast<double>(rays) * 49))};
    return out;
}

// In a process of its own: Embree ends it at the first ray that is none.
Outcome no_rays(const Setup& setup)
{
    const Geometry g = of_mesh(to_mesh(*make_uv_sphere(24, 48, 0.1)));
    const auto accel = setup.make(g);
    const auto count_wrong = [&] {
        const Ray good{.org = {3, 0.1f, 0.2f}, .dir = {-1, 0, 0}};
        const Hit expected = accel->closest(good);
        int wrong = expected ? 0 : 1;
        for (int field = 0; field < 8; ++field)
            for (const float bad : {nan, -nan, inf, -inf, 2e18f, -2e18f, std::numeric_limits<float>::max()}) {
                Ray ray = good;
                float* const fields[] = {&ray.org.x, &ray.org.y, &ray.org.z, &ray.dir.x,
                                         &ray.dir.y, &ray.dir.z, &ray.t_min, &ray.t_max};
                *fields[field] = bad;
                // Only the end may be anything at or above the beginning.
                const bool hits = field == 7 && bad > 0;
                wrong += static_cast<bool>(accel->closest(ray)) != hits || accel->any(ray) != hits;
                // Its neighbours in a batch do not notice.
                std::array<Ray, 11> many;
                many.fill(good);
                many[static_cast<size_t>(field)] = ray;
                std::array<Hit, 11> found;
                std::array<uint8_t, 11> met;
                accel->closest(many, found, Coherence::incoherent);
                accel->any(many, met);
                for (size_t i = 0; i < many.size(); ++i) {
                    const bool expects = i != static_cast<size_t>(field) || hits;
                    wrong += static_cast<bool>(found[i]) != expects || (met[i] != 0) != expects;
                    wrong += i != static_cast<size_t>(field) && !same_bits(found[i], expected);
                }
            }
        return wrong;
    };
    const pid_t child = fork();
    if (child == 0) {
        freopen("/dev/null", "w", stderr);
        _exit(std::min(count_wrong(), 255));
    }
    int status = 0;
    waitpid(child, &status, 0);
    Outcome out;
    out.measures = {at_most("signals", WIFEXITED(status) ? 0 : 1, 0),
                    at_most("wrong answers", WIFEXITED(status) ? double(WEXITSTATUS(status)) : double(NAN), 0)};
    return out;
}

}  // namespace

std::vector<Row> ray_rows()
{
    return {
        {"R1", "rays parallel to axes, zeros of both signs", "double", Tier::A, true, along_axes},
        {"R2", "rays along edges and through corners", "policy", Tier::A, true, at_edges},
        {"R3", "rays that begin or end on a triangle, or lie in it", "policy", Tier::A, true, ends_of_rays},
        {"R4", "no, denormal, tiny and huge directions", "policy", Tier::A, true, odd_directions},
        {"R5", "NaN and infinity in every field of a ray", "policy", Tier::A, true, no_rays},
        {"R6", "many rays of every kind", "double", Tier::A, true, many_rays},
        {"R7", "ten thousand balls through each other", "long double", Tier::A, false, nearest_of_many},
    };
}

}  // namespace lancer::stability
