// Footprints of rays: how wide they are after each kind of bounce, and that averaging a texture over them takes noise
// away and leaves the mean.
#include <gtest/gtest.h>

#include "render/kernel/kernel.h"
#include "support/rasters.h"
#include "support/shoot.h"
#include "support/stage.h"

namespace lancer {
namespace {

// A floor of fine stripes, black and white, and what the camera sees it by.
enum class Route { straight, flat_mirror, round_mirror, glass, glossy, matt };
constexpr std::array<Route, 6> routes{Route::straight, Route::flat_mirror, Route::round_mirror,
                                      Route::glass,    Route::glossy,      Route::matt};
constexpr std::array<const char*, 6> route_names{"straight", "flat mirror", "round mirror", "glass", "glossy", "matt"};

constexpr double uv_per_length = 32;
Raster stripes()
{
    return make_raster(256, 1, [](uint32_t x, uint32_t) { return x % 2 ? Color{1, 1, 1} : Color{}; });
}

SceneDescription striped_floor(Route route)
{
    SceneDescription d;
    MaterialDescription striped = make_lambert("striped", {1, 1, 1});
    striped.base_color_map = picture_of("stripes", Encoding::linear);
    constexpr auto uv = static_cast<float>(8 * uv_per_length);
    d.meshes.push_back(make_mesh(make_mapped_quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}, {uv, uv}, striped)));
    d.lights.push_back(sky_of({1, 1, 1}));
    d.camera = make_camera({0, 4, 1}, {0, 0, 0}, 20);
    if (route == Route::straight) return d;
    MaterialDescription m = make_glossy("between", MaterialType::mirror, {1, 1, 1}, 0);
    if (route == Route::glass) m.type = MaterialType::glass;
    if (route == Route::glossy) m.type = MaterialType::metal, m.roughness = 0.5f;
    if (route == Route::matt) m.type = MaterialType::lambert;
    if (route == Route::round_mirror) {
        d.materials = {m};
        d.spheres.push_back(sphere_of({0, 1, -1}, 1, "between"));
        d.camera = make_camera({0, 1, 3}, {0, 0.8, -1}, 20);
    } else if (route == Route::glass) {
        d.meshes.push_back(make_mesh(make_cube(m), {{0, 1, 0}, {}, {3, 0.1, 3}}));
    } else {
        d.meshes.push_back(make_mesh(make_quad({-3, 0, -2}, {3, 0, -2}, {3, 3, -2}, {-3, 3, -2}, m)));
        d.camera = make_camera({0, 2, 1.5}, {0, 1.2, -2}, 20);
    }
    return d;
}

// Looks textures up at their finest level.
struct Sharp {
    Path path;
    template <class V>
    void hit(const V& view, const PathState& s, const Surface& surface, const Sampler& sampler,
             PathActions& actions) const
    {
        Surface point = surface;
        point.uv_width = 0;
        path.hit(view, s, point, sampler, actions);
    }
    template <class V>
    void miss(const V& view, const PathState& s, PathActions& actions) const
    {
        path.miss(view, s, actions);
    }
};

constexpr uint32_t side = 160;

// One sample in each pixel.
template <class Integrator, class Listener>
stats::Tally trace(Route route, const Integrator& integrator, uint64_t seed, const Listener& listener)
{
    const SceneDescription d = striped_floor(route);
    const Stage stage(d, picture_source(stripes()));
    Workspace w;
    for (uint32_t i = 0; i < side * side; ++i) w.slots.push_back({i % side, i / side, 0});
    const KernelSettings settings{
        .sampler = SamplerKind::independent, .seed = salted(seed), .filter = Filter(FilterKind::box)};
    Counters counters;
    trace_batch(View{stage.scene, SamplingPlan{}}, *stage.embree, camera_of(d, stage.scene, side, side), side, settings,
                integrator, w, counters, listener);
    stats::Tally t;
    for (const RadianceSum& c : w.queue.radiance) t.add(static_cast<double>(luminance(c.color())));
    return t;
}

TEST(RayCones, TakeNoiseAwayAndLeaveTheMean)
{
    stats::Family family;
    for (const Route route : routes) {
        const std::string name = route_names[static_cast<size_t>(route)];
        const Path path = without_roulette({.max_depth = route == Route::glass ? 7u : 2u});
        const stats::Tally wide = trace(route, path, 1, NoListener{}),
                           sharp = trace(route, Sharp{path}, 2, NoListener{});
        EXPECT_GT(wide.mean, 0.1) << name;
        family.add(stats::welch_p(wide, sharp), name);
        std::printf("%s: variance %.3g instead of %.3g; biases above %.2g %% would show\n", name.c_str(),
                    wide.variance(), sharp.variance(), 400 * sharp.error() / sharp.mean);
        EXPECT_LT(wide.variance(), 0.9 * sharp.variance()) << name;
    }
}

// A sky of 1 and no second bounce: each sample is the texture itself, and the mean of its footprint at once.
TEST(RayCones, OneSampleHasTheMeanOfItsFootprint)
{
    const Path path{.max_depth = 1, .direct = {.nee = false}};
    EXPECT_NEAR(trace(Route::straight, Sharp{path}, 1, NoListener{}).variance(), 1.0 / 12, 0.01);  // bilinear
    const stats::Tally t = trace(Route::straight, path, 1, NoListener{});
    EXPECT_NEAR(t.mean, 0.5, 1e-3);
    EXPECT_LT(t.variance(), 1e-6);
}

// Pixels of planks that are seen at grazing angles, by the mean of many samples each.
constexpr uint32_t planks_width = 48, planks_height = 12;
template <class Integrator>
std::vector<double> planks(const Integrator& integrator, uint64_t seed)
{
    constexpr uint32_t samples = 512;
    const Raster picture = make_raster(64, 64, [](uint32_t x, uint32_t y) {
        const float shade = static_cast<float>((x / 3 * 7 + y / 16 * 5) % 8) / 8;
        return x % 3 == 0 ? Color{} : Color{shade, shade, shade};
    });
    SceneDescription d = striped_floor(Route::straight);
    d.meshes.clear();
    MaterialDescription floor = make_lambert("planks", {1, 1, 1});
    floor.base_color_map = picture_of("planks", Encoding::linear);
    d.meshes.push_back(make_mesh(make_mapped_quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}, {8, 8}, floor)));
    d.camera = make_camera({0, 0.3, 4}, {0, 0, 0.5}, 15);
    const Stage stage(d, picture_source(picture));
    std::vector<double> sums(planks_width * planks_height);
    for (uint32_t sample = 0; sample < samples; ++sample) {
        Workspace w;
        for (uint32_t i = 0; i < sums.size(); ++i) w.slots.push_back({i % planks_width, i / planks_width, sample});
        const KernelSettings settings{
            .sampler = SamplerKind::sobol, .seed = salted(seed), .filter = Filter(FilterKind::box)};
        Counters counters;
        trace_batch(View{stage.scene, SamplingPlan{}}, *stage.embree,
                    camera_of(d, stage.scene, planks_width, planks_height), planks_width, settings, integrator, w,
                    counters, NoListener{});
        for (size_t i = 0; i < sums.size(); ++i)
            sums[i] += static_cast<double>(luminance(w.queue.radiance[i].color())) / samples;
    }
    return sums;
}

// Footprints blur a picture that has converged. The product of the differences of two pairs of pictures has the square
// of the bias as its mean, without their noise.
TEST(RayCones, LeaveTexturesAsSharpAsThePixels)
{
    const Path path{.max_depth = 1, .direct = {.nee = false}};
    const auto wide = planks(path, 1), other_wide = planks(path, 2);
    const auto sharp = planks(Sharp{path}, 3), other_sharp = planks(Sharp{path}, 4);
    double bias2 = 0, power = 0, contrast = 0;
    for (size_t i = 0; i < wide.size(); ++i) {
        bias2 += (wide[i] - sharp[i]) * (other_wide[i] - other_sharp[i]);
        power += sharp[i] * other_sharp[i];
        const size_t next = i % planks_width + 1 < planks_width ? i + 1 : i;
        contrast += (sharp[i] - sharp[next]) * (other_sharp[i] - other_sharp[next]);
    }
    EXPECT_GT(contrast / power, 1e-2);  // there is something to blur
    EXPECT_LT(bias2 / power, 1e-4);
}

// A cone keeps its angle when mirrored or refracted; else it opens to that of a sixteenth of the solid angle that the
// sample stands for.
struct ConesOfPixels : NoListener {
    RayCone camera_cone;
    float uv_per_scene_unit;
    std::vector<RayCone>& cones;  // of each slot
    float& worst;                 // relative error of a footprint
    int& checked;

    void vertex(const PathState& s, const Surface& surface) const
    {
        RayCone& cone = cones[s.slot];
        if (s.depth == 0) cone = camera_cone;
        if (!s.specular) cone.spread = std::min(1.0f, std::max(cone.spread, std::sqrt(1 / s.pdf / 16)));
        cone.width += cone.spread * surface.t;
        if (surface.uv_width == 0) return;  // not on the floor
        worst = std::max(worst, std::abs(cone.width * uv_per_scene_unit / surface.uv_width - 1));
        ++checked;
    }
};

TEST(RayCones, AreAsWideAsTheirWayIsLong)
{
    for (const Route route : routes) {
        const SceneDescription d = striped_floor(route);
        const Scene scene = build_scene(d, picture_source(stripes()));
        const RayCone camera_cone = camera_of(d, scene, side, side).cone();
        EXPECT_EQ(camera_cone.width, 0);
        EXPECT_NEAR(camera_cone.spread, 2 * std::tan(std::numbers::pi / 18) / side / 8, 1e-7);
        std::vector<RayCone> cones(side * side);
        float worst = 0;
        int checked = 0;
        const ConesOfPixels listener{{},    camera_cone, static_cast<float>(uv_per_length / scene.normalisation.scale),
                                     cones, worst,       checked};
        trace(route, Path{.max_depth = 5}, 1, listener);
        EXPECT_LT(worst, 1e-4f) << route_names[static_cast<size_t>(route)];
        EXPECT_GT(checked, 200) << route_names[static_cast<size_t>(route)];
    }
}

}  // namespace
}  // namespace lancer
