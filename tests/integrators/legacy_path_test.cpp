// The student's path tracer against what it computed: its room, point by point in double, and its rules one by one.
#include "integrators/legacy/path.h"

#include <gtest/gtest.h>

#include "integrators/view.h"
#include "support/shoot.h"
#include "support/stage.h"

namespace lancer {
namespace {

constexpr double pi_twice = 2 * std::numbers::pi;

// A ball in a room between spheres so large that they are nearly walls. The light: radius 8, radiance 10.
SceneDescription room(MaterialDescription ball)
{
    SceneDescription d;
    ball.name = "ball";
    d.materials = {std::move(ball), make_lambert("front", {1, 0, 1}), make_lambert("back", {0, 1, 1}),
                   make_lambert("white", {1, 1, 1}), make_lambert("side", {0.5f, 0.25f, 0})};
    d.spheres = {sphere_of({0, 0, 15}, 10, "ball"),      sphere_of({0, 0, -1000}, 940, "front"),
                 sphere_of({0, 0, 1000}, 940, "back"),   sphere_of({0, 1000, 0}, 940, "white"),
                 sphere_of({0, -1000, 0}, 990, "white"), sphere_of({-1000, 0, 0}, 940, "side"),
                 sphere_of({1000, 0, 0}, 940, "side")};
    d.lights.push_back(light_of(LightType::sphere, {10, 10, 10}, {-10, 20, 40}, 8));
    d.camera = make_camera({0, 0, 55}, {0, 0, 0}, 60);
    return d;
}
SceneDescription matt_room() { return room(make_lambert("", {0.1f, 0.1f, 1})); }
MaterialDescription of_type(MaterialType type)
{
    MaterialDescription m = make_lambert("", {1, 1, 1});
    m.type = type;
    return m;
}

constexpr LegacyPath hard{.indirect = false, .soft_shadows = false};

Film shoot_room(const SceneDescription& d, const LegacyPath& integrator, uint32_t spp = 1, uint64_t seed = 0)
{
    return shoot(d, {.integrator = integrator, .spp = spp, .seed = seed});
}

// Distance along a ray to the nearest sphere, and which one; the light is the last.
struct Found {
    double t = std::numeric_limits<double>::infinity();
    size_t sphere = 0;
};
Found find(const std::vector<Sphere>& spheres, Vec3d org, Vec3d dir)
{
    Found found;
    for (size_t i = 0; i < spheres.size(); ++i) {
        const Vec3d to = org - spheres[i].center;
        const double b = dot(to, dir), under = b * b - dot(to, to) + spheres[i].radius * spheres[i].radius;
        if (under < 0) continue;
        const double t = -b - std::sqrt(under) >= 0 ? -b - std::sqrt(under) : -b + std::sqrt(under);
        if (t >= 0 && t < found.t) found = {t, i};
    }
    return found;
}

// Direct light of the room with hard shadows, as written down for the program: all in double, in units of the file.
TEST(LegacyPath, DirectLightWithHardShadowsIsThatOfTheProgram)
{
    const SceneDescription d = matt_room();
    std::vector<Sphere> spheres;
    std::vector<Color> albedo;
    for (const SphereDescription& s : d.spheres) {
        spheres.push_back({s.center, s.radius});
        for (const MaterialDescription& m : d.materials)
            if (m.name == s.material) albedo.push_back(m.base_color);
    }
    const Vec3d lamp = d.lights[0].position;
    const double radius = d.lights[0].radius, intensity = 10 * pi_twice * pi_twice * radius * radius;
    spheres.push_back({lamp, radius});

    constexpr uint32_t side = 96;
    RenderRequest r;
    r.width = r.height = side, r.spp = {1};
    r.settings.integrator = hard;
    r.settings.kernel.filter = Filter(FilterKind::centre);
    const Film film = render(d, r).film;
    int wrong = 0, dark = 0;
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const Vec3d eye{0, 0, 55};
            const Vec3d dir = normalize(Vec3d{x + 0.5 - side / 2., side / 2. - y - 0.5, -(side / 2.) * std::sqrt(3.0)});
            const Found hit = find(spheres, eye, dir);
            ASSERT_LT(hit.sphere, albedo.size());
            const Vec3d p = eye + dir * hit.t, n = normalize(p - spheres[hit.sphere].center);
            const Vec3d to = lamp - p;
            const double distance = length(to);
            const bool seen = find(spheres, p + n * 0.01, to / distance).t >= 0.99 * (distance - radius);
            const double e = seen ? intensity / (2 * pi_twice * distance * distance) * 2 / pi_twice *
                                        std::max(0.0, dot(n, to) / distance)
                                  : 0;
            const Color got = film.at(x, y).mean(), want = albedo[hit.sphere] * static_cast<float>(e);
            dark += is_black(want);
            const auto near = [](float a, float b) { return std::abs(a - b) <= 1e-3f * std::abs(b) + 1e-5f; };
            wrong += !(near(got.r, want.r) && near(got.g, want.g) && near(got.b, want.b));
        }
    // Where an edge goes through the middle of a pixel float may see its other side.
    EXPECT_LE(wrong, 5);
    EXPECT_GT(dark, 100) << "no shadow to be seen";
}

// A sphere of light sends what a point of its intensity does wherever all of it is above the horizon.
TEST(LegacyPath, SoftShadowsLightAsHardOnesWhereNothingIsInTheWay)
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {0.7f, 0.5f, 0.3f})};
    d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "floor"));
    // As large as its rooms: the length by which rays start off the surface lets small lamps shade themselves.
    d.lights.push_back(light_of(LightType::sphere, {3, 3, 3}, {15, 90, 0}, 30));
    d.camera = make_camera({0, 60, 60}, {0, 0, 0}, 20);
    LegacyPath soft = hard;
    soft.soft_shadows = true;
    Shot shot{.integrator = hard, .spp = 512, .sampler = SamplerKind::independent, .seed = 5};
    const Film sharp = shoot(d, shot);  // of the same places
    shot.integrator = soft;
    const Film film = shoot(d, shot);
    stats::Family family;
    for (size_t i = 0; i < film.pixels.size(); i += 7) {
        ASSERT_GT(tally(film.pixels[i]).variance(), 4 * tally(sharp.pixels[i]).variance());
        family.add(stats::mean_p(tally(film.pixels[i]), tally(sharp.pixels[i]).mean, 1e-4),
                   "pixel " + std::to_string(i));
    }
}

TEST(LegacyPath, EndsAfterFiveVerticesUnlessToldOtherwise)
{
    const SceneDescription d = matt_room();
    const auto make = [](uint32_t depth) {
        return std::get<LegacyPath>(make_integrator({.max_depth = depth, .legacy = true}));
    };
    const Film usual = shoot_room(d, make(0), 4);
    EXPECT_TRUE(same_bits(usual, shoot_room(d, make(5), 4)));
    EXPECT_LT(tally(shoot_room(d, make(4), 4)).mean, tally(usual).mean);
    EXPECT_LT(tally(usual).mean, tally(shoot_room(d, make(6), 4)).mean);
    LegacyPath direct = make(0);
    direct.indirect = false;
    EXPECT_TRUE(same_bits(shoot_room(d, direct, 4), shoot_room(d, make(1), 4)));
}

// The floor is lit by the ceiling, which the lamp between them lights: what the second vertex adds has its colour, and
// the albedo of the floor as its weight.
TEST(LegacyPath, IndirectLightIsWeighedByTheAlbedo)
{
    LegacyPath twice = hard;
    twice.indirect = true;
    twice.max_depth = 2;
    const auto added = [&](float albedo) {
        SceneDescription d;
        d.materials = {make_lambert("floor", {albedo, albedo, albedo}), make_lambert("ceiling", {1, 0.5f, 0.25f})};
        d.planes = {plane_of({0, 0, 0}, {0, 1, 0}, "floor"), plane_of({0, 4, 0}, {0, -1, 0}, "ceiling")};
        d.lights.push_back(light_of(LightType::sphere, {5, 5, 5}, {0, 2, 0}, 0.1));
        d.camera = make_camera({0, 1, 1}, {0, 0, 0}, 30);
        const auto sum = [&](const LegacyPath& integrator) {
            Color all;
            for (const Pixel& p : shoot_room(d, integrator, 64).pixels) all += p.mean();
            return all;
        };
        return sum(twice) - sum(hard);
    };
    const Color half = added(0.5f), whole = added(1);
    EXPECT_GT(half.r, 0);
    EXPECT_NEAR(half.g / half.r, 0.5f, 1e-3f);
    EXPECT_NEAR(half.b / half.r, 0.25f, 1e-3f);
    EXPECT_NEAR(half.r / whole.r, 0.5f, 1e-3f);
}

TEST(LegacyPath, ALightThatIsSeenHasItsIntensityAlsoInMirrorsButNotThroughGlass)
{
    SceneDescription d;
    d.lights.push_back(light_of(LightType::sphere, {2, 3, 4}, {0, 0, -5}, 2));
    d.camera = make_camera({0, 0, 5}, {0, 0, 0}, 2);
    const float times = static_cast<float>(pi_twice * pi_twice * 4);
    const LegacyPath direct = hard;
    expect_all_equal(shoot_room(d, direct), Color{2, 3, 4} * times, 1e-5f, "seen");
    expect_all_equal(shoot_room(scaled_by(d, 8), direct), Color{2, 3, 4} * (64 * times), 1e-5f, "in larger units");
    LegacyPath blind = direct;
    blind.emitters = false;
    expect_all_equal(shoot_room(d, blind), {}, 0, "not asked for");

    SceneDescription mirrored = d;
    mirrored.materials = {of_type(MaterialType::mirror)};
    mirrored.materials[0].name = "mirror";
    mirrored.planes.push_back(plane_of({0, 0, -8}, {0, 0, 1}, "mirror"));
    mirrored.camera = make_camera({5, 0, -5}, {2.5, 0, -8}, 2);
    expect_all_equal(shoot_room(mirrored, direct), Color{2, 3, 4} * times, 1e-5f, "in a mirror");

    SceneDescription behind_glass = d;
    behind_glass.materials = {of_type(MaterialType::glass)};
    behind_glass.materials[0].name = "glass";
    behind_glass.spheres.push_back(sphere_of({0, 0, 0}, 1, "glass"));
    expect_all_equal(shoot_room(behind_glass, direct, 4), {}, 0, "through glass");

    // There it is a white ball, which shows the light of the floor below it in the floor's colour.
    behind_glass.materials.push_back(make_lambert("floor", {1, 0.5f, 0.25f}));
    behind_glass.planes.push_back(plane_of({0, -4, 0}, {0, 1, 0}, "floor"));
    LegacyPath all = direct;
    all.indirect = true;
    all.fresnel = false;
    all.max_depth = 4;  // the glass twice, the ball, the floor
    Color sum;
    for (const Pixel& p : shoot_room(behind_glass, all, 16).pixels) sum += p.mean();
    EXPECT_GT(sum.r, 0);
    EXPECT_NEAR(sum.g / sum.r, 0.5f * 3 / 2, 1e-3f);
    EXPECT_NEAR(sum.b / sum.r, 0.25f * 4 / 2, 1e-3f);
}

// How often glass reflects, and where its rays start.
TEST(LegacyPath, GlassReflectsBySchlickWithTheCosineOfTheSideOfTheRay)
{
    SceneDescription d;
    MaterialDescription glass = of_type(MaterialType::glass);
    glass.name = "glass";
    d.materials = {glass};
    d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "glass"));
    d.camera = make_camera({0, 8, 8}, {0, 0, 0}, 30);
    const Stage stage(d);
    const SamplingPlan no_plan;
    const View view{stage.scene, no_plan};
    const float unit = static_cast<float>(stage.scene.normalisation.scale);
    constexpr uint32_t tries = 20000;
    stats::Family family;
    for (const bool leaves : {false, true})
        for (const double angle : {0.0, 0.4, 0.7, 1.2, 1.5}) {
            const float up = leaves ? 1.0f : -1.0f;
            PathState s;
            s.ray.dir = to_float(Vec3d{std::sin(angle), up * std::cos(angle), 0});
            const auto surface = stage.look(s.ray.dir * -unit, s.ray.dir);
            ASSERT_TRUE(surface);
            const double cos = std::cos(angle), eta = leaves ? 1.5 : 1 / 1.5;
            const bool total = eta * std::sin(angle) > 1;
            const double schlick = total ? 1 : 0.04 + 0.96 * std::pow(1 - cos, 5);
            uint32_t reflected = 0;
            Queue queue;
            queue.radiance.resize(1);
            for (uint32_t i = 0; i < tries; ++i) {
                queue.next.clear();
                PathActions actions(queue, 0);
                const Sampler sampler(SamplerKind::independent, 9, 0, i, 0);
                LegacyPath{}.hit(view, s, *surface, sampler, actions);
                ASSERT_EQ(queue.next.size(), 1u);
                const Ray& ray = queue.next[0].ray;
                const bool back = ray.dir.y * up < 0;
                reflected += back;
                const float expected = static_cast<float>(back ? std::sin(angle) : eta * std::sin(angle));
                ASSERT_NEAR(ray.dir.x, expected, 1e-6f);
                ASSERT_NEAR(ray.org.y, (back ? -up : up) * 0.01f * unit, 1e-6f * unit);
                ASSERT_FALSE(queue.next[0].specular);
                LegacyPath plain;
                plain.fresnel = false;
                queue.next.clear();
                plain.hit(view, s, *surface, sampler, actions);
                ASSERT_EQ(queue.next[0].ray.dir.y * up < 0, total);
            }
            if (total) {
                EXPECT_EQ(reflected, tries);
                continue;
            }
            const double sigma = std::sqrt(tries * schlick * (1 - schlick));
            family.add(stats::normal_p((reflected - tries * schlick) / sigma),
                       (leaves ? "leaving at " : "entering at ") + std::to_string(angle));
        }
}

// Seen from the back a surface gets no direct light: its normal is not turned round.
TEST(LegacyPath, BacksAreBlack)
{
    SceneDescription d;
    d.materials = {make_lambert("sheet", {1, 1, 1})};
    d.planes.push_back(plane_of({0, 0, 0}, {0, 0, -1}, "sheet"));
    d.lights.push_back(light_of(LightType::sphere, {5, 5, 5}, {0, 3, 5}, 1));
    d.camera = make_camera({0, 0, 5}, {0, 0, 0}, 10);
    expect_all_equal(shoot_room(d, hard), {}, 0, "the back");
    d.planes[0].normal = {0, 0, 1};
    EXPECT_GT(tally(shoot_room(d, hard)).mean, 0);
}

// A sheet between the floor and the lamp, 0.4 % of the way before its center: within what shadow rays leave out.
TEST(LegacyPath, ShadowRaysEndALittleEarly)
{
    SceneDescription d;
    d.materials = {make_lambert("floor", {1, 1, 1})};
    d.planes.push_back(plane_of({0, 0, 0}, {0, 1, 0}, "floor"));
    d.lights.push_back(light_of(LightType::sphere, {500, 500, 500}, {0, 10, 0}, 0.01));
    d.camera = make_camera({0, 5, 3}, {0, 0, 0}, 10);
    const double lit = tally(shoot_room(d, hard)).mean;
    for (const bool soft : {false, true}) {
        LegacyPath integrator = hard;
        integrator.soft_shadows = soft;
        for (const double height : {9.96, 9.8}) {
            SceneDescription shaded = d;
            shaded.meshes.push_back(make_mesh(make_quad({-3, height, 3}, {3, height, 3}, {3, height, -3},
                                                        {-3, height, -3}, make_lambert("sheet", {0, 0, 0}))));
            const double mean = tally(shoot_room(shaded, integrator)).mean;
            if (height > 9.9)
                EXPECT_NEAR(mean, lit, 0.02 * lit) << soft;
            else
                EXPECT_EQ(mean, 0) << soft;
        }
    }
}

// Nor does it matter to it how the work is cut up.
TEST(LegacyPath, GivesTheSameBitsHoweverTheWorkIsCutUp)
{
    std::vector<SceneDescription> scenes{matt_room(), room(of_type(MaterialType::glass)), lights_scene(),
                                         textured_scene(), holes_scene()};
    for (size_t i = 0; i < scenes.size(); ++i) {
        RenderRequest r;
        r.settings.integrator = LegacyPath{};
        const Film usual = render(scenes[i], r).film;
        EXPECT_GT(tally(usual).mean, 0.01) << i;
        r.threads = 3, r.tile = 7, r.settings.kernel.batch = 33;
        r.settings.accel = AccelKind::list;
        EXPECT_TRUE(same_bits(usual, render(scenes[i], r).film)) << i;
    }
}

}  // namespace
}  // namespace lancer
