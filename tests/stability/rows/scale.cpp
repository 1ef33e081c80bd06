// Rows N of the stability matrix: how large a scene is and where it lies.
#include "stability/exact.h"
#include "stability/obj_text.h"
#include "stability/pictures.h"
#include "support/addressed.h"
#include "support/double_tree.h"
#include "support/hits.h"

namespace lancer::stability {
namespace {

// Tier A: four powers; every power and every accelerator only of one scene of meshes and one of everything else.
Outcome powers_of_two(const Setup& setup)
{
    Outcome out;
    double differ = 0;
    for (const auto& [name, d] : all_test_scenes()) {
        const bool whole = setup.tier != Tier::A || name == std::string("cornell");
        for (const AccelKind accel : judged_kinds) {
            if (!whole && accel != AccelKind::automatic) continue;
            CountedShot shot{.width = 16, .height = 12, .spp = 2, .accel = accel};
            if (whole) shot.integrator = Path{};  // with a pilot, which must plan the same
            const Film one = take(d, shot, out);
            for (int k = -20; k <= 20; ++k)
                if (k != 0 && (k % 10 == 0 || (whole && accel == AccelKind::automatic)))
                    differ += pixels_that_differ(one, take(scaled_by(d, std::ldexp(1.0, k)), shot, out));
        }
    }
    out.measures = {at_most("pixels with other bits, nine scenes, 2^-20 to 2^20", differ, 0)};
    return out;
}

Outcome powers_of_ten(const Setup& setup)
{
    Outcome out;
    LeastP least;
    const auto pictures = static_cast<uint32_t>(setup.scaled(16, 24, 96));
    Measure bias;
    for (const SceneDescription& d : {cornell_scene(), lights_scene()}) {
        CountedShot shot{.spp = static_cast<uint32_t>(setup.scaled(2, 64, 128)), .accel = AccelKind::embree, .seed = 1};
        const auto one = tiles_over_seeds(d, shot, pictures, out);
        for (int k = -6; k <= 6; ++k) {
            if (k == 0) continue;
            shot.seed = static_cast<uint64_t>(k + 20);
            const auto other = tiles_over_seeds(scaled_by(d, std::pow(10.0, k)), shot, pictures, out);
            least.add(one, other);
            bias = detectable(one, other);
        }
    }
    out.measures = {least.measure("least p of Welch's tests per tile, two scenes, 10^-6 to 10^6"), bias};
    return out;
}

// What float would hold of the scene had it not been moved: corners and camera rounded there and brought back.
SceneDescription without_recentring(SceneDescription d, Vec3d shift)
{
    const auto rounded = [&](Vec3d p) { return to_double(to_float(p)) - shift; };
    MeshData data = *d.meshes[0].data;
    for (Vec3d& p : data.positions) p = rounded(p);
    d.meshes[0].data = std::make_shared<const MeshData>(std::move(data));
    d.camera->position = rounded(d.camera->position), d.camera->target = rounded(d.camera->target);
    return d;
}

// In tenths of a millimetre, as it was measured: nine digits hold that at 1e7.
Outcome far_away(const Setup& setup)
{
    constexpr double size = 100;
    constexpr const char* digits = "%.9g";
    const auto at = [&](double t) { return moved_cornell(size, Vec3d{1, -1, 1} * t, digits); };
    Outcome out;
    CountedShot shot{.width = 16, .height = 16, .spp = static_cast<uint32_t>(setup.scaled(512, 4096, 4096))};
    shot.threads = setup.tier == Tier::A ? 1 : 2;
    const SceneDescription here = at(0);
    const Film reference = take(here, shot, out);
    for (const double t : {1e4, 1e5})
        out.measures.push_back(
            at_most("RMSE of the same samples at " + std::to_string(static_cast<int>(t)) + ", relative",
                    relative_rmse(reference, take(at(t), shot, out)), 1e-3));
    const auto pictures = static_cast<uint32_t>(setup.scaled(16, 32, 64));
    shot.spp = static_cast<uint32_t>(setup.scaled(16, 256, 256)), shot.seed = 1;
    const auto near = tiles_over_seeds(here, shot, pictures, out);
    for (const double t : {1e6, 1e7}) {
        ++shot.seed;
        const auto far = tiles_over_seeds(at(t), shot, pictures, out);
        LeastP least;
        least.add(near, far);
        out.measures.push_back(least.measure("least p of Welch's tests at " + std::to_string(static_cast<int>(t))));
        if (t == 1e7) out.measures.push_back(detectable(near, far));
    }
    ++shot.seed;
    LeastP control;
    control.add(near, tiles_over_seeds(without_recentring(at(1e7), Vec3d{1, -1, 1} * 1e7), shot, pictures, out));
    out.measures.push_back(at_most("the same without recentring: must fail", control.p, control.threshold()));
    return out;
}

Outcome two_clusters(const Setup& setup)
{
    SceneDescription d;
    const auto ball = make_uv_sphere(24, 48, 0.1);
    d.meshes = {make_mesh(ball, {{0, 0, 0}, {}, {0.5, 0.5, 0.5}}), make_mesh(ball, {{1e6, 0, 0}, {}, {0.5, 0.5, 0.5}})};
    d.lights.push_back(sky_of({1, 1, 1}));
    const Scene scene = build_scene(d);
    const DoubleTree reference(scene.geometry);
    const auto accel = setup.make(scene.geometry);
    const size_t count = setup.scaled(40000, 1000000, 1000000);
    double across = 0, within = 0, worst = 0, hits = 0;
    for (size_t i = 0; i < count; ++i) {
        AddressedRandom random(1, i);
        const auto place = [&](bool far, double radius) {
            const Vec3d p = random.direction() * radius;
            return scene.normalisation.to_scene(Vec3d{far ? 1e6 : 0, 0, 0} + p);
        };
        // From around one of them, and at it or at the other.
        const bool from = random.below(2), crosses = random.below(4) == 0;
        const Vec3 org = to_float(place(from, 1.5));
        const Vec3d target = place(from != crosses, 0.5 * random.uniform());
        const Ray ray{.org = org, .dir = to_float(normalize(target - to_double(org)))};
        const Hit expected = reference.closest(ray), found = accel->closest(ray);
        const bool both = expected && found;
        const bool wrong = static_cast<bool>(expected) != static_cast<bool>(found) ||
                           (both && !same_primitive(expected, found) &&
                            ulps_between(static_cast<double>(found.t), static_cast<double>(expected.t)) > 4);
        (crosses ? across : within) += wrong;
        hits += found ? 1 : 0;
        if (found && same_primitive(expected, found))
            worst = std::max(worst, ulps_between(static_cast<double>(found.t), triangle_t(scene.geometry, ray, found)));
    }
    Outcome out;
    out.measures = {at_most("wrong hits of rays within a cluster", within, 0),
                    at_most("wrong hits of rays from one to the other", across, 0),
                    at_most("error of t, ulps", worst, 4), told("part of the rays that hit", hits / double(count))};
    return out;
}

bool has_point_light(const SceneDescription& d)
{
    return std::any_of(d.lights.begin(), d.lights.end(),
                       [](const LightDescription& l) { return l.type == LightType::point; });
}

// Whether sizes next to the limits of float, and beyond, look like 2^k times as much. The intensity of a point light
// grows with the square, which float does not hold; radiances stay.
Outcome extreme_sizes(const std::vector<double>& sizes)
{
    Outcome out;
    double differ = 0, dark = 0;
    for (const double size : sizes) {
        const double normal = std::ldexp(size, -std::ilogb(size));
        for (const auto& [name, d] : all_test_scenes()) {
            if (has_point_light(d)) continue;
            const CountedShot shot{.width = 16, .height = 12, .spp = 4};
            const Film film = take(scaled_by(d, size), shot, out);
            differ += pixels_that_differ(take(scaled_by(d, normal), shot, out), film);
            dark += mean_luminance(film) > 0.01 ? 0 : 1;
        }
        for (const AccelKind accel : judged_kinds) {
            const CountedShot shot{.width = 16, .height = 16, .spp = 4, .accel = accel};
            const Film film = take(moved_cornell(size, {}, "%.17g"), shot, out);
            differ += pixels_that_differ(take(moved_cornell(normal, {}, "%.17g"), shot, out), film);
            dark += mean_luminance(film) > 0.01 ? 0 : 1;
        }
    }
    out.measures = {at_most("pixels with other bits than at size 1", differ, 0),
                    at_most("pictures in which nothing is seen", dark, 0)};
    return out;
}

}  // namespace

std::vector<Row> scale_rows()
{
    return {
        {"N1", "scene times 2^k", "itself at scale 1", Tier::A, false, powers_of_two},
        {"N2", "scene times 10^k", "itself at scale 1", Tier::A, false, powers_of_ten},
        {"N3", "scene up to 1e7 from the origin, nine digits", "itself at the origin", Tier::A, false, far_away},
        {"N4", "two clusters of size 1, 1e6 apart", "double, long double", Tier::A, true, two_clusters},
        {"N5", "scene of size 1e-10, 1e-20", "itself times 2^k", Tier::A, false,
         [](const Setup&) {
             return extreme_sizes({1e-10, 1e-20});
         }},
        {"N6", "scene of size 1e18, 1e19, 1e30: beyond what Embree takes", "itself times 2^-k", Tier::A, false,
         [](const Setup&) {
             return extreme_sizes({1e18, 1e19, 1e30});
         }},
    };
}

}  // namespace lancer::stability
