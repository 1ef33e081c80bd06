// Environment maps: where a direction is in the picture, and that drawing directions follows what is looked up.
#include "scene/environment/environment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.h"
#include "support/rasters.h"
#include "support/scenes/scenes.h"
#include "support/statistics/chi_square.h"
#include "support/statistics/significance.h"

namespace lancer {
namespace {

EnvironmentMap make_map(Raster r, Vec3d rotate_deg = {}, Color constant = {}, double compensation = 0)
{
    return {std::make_shared<const Raster>(std::move(r)), {1, 1, 1}, constant, rotate_deg, compensation};
}

// Smooth, everywhere lit, different in every direction.
Raster smooth(uint32_t width, uint32_t height)
{
    return make_raster(width, height, [=](uint32_t x, uint32_t y) {
        const double lon = 2 * pi_d * (x + 0.5) / width, lat = pi_d * (y + 0.5) / height;
        return Color{static_cast<float>(1.2 + std::cos(lon) * std::sin(lat)),
                     static_cast<float>(1.1 + std::sin(lon) * std::sin(lat)), static_cast<float>(1.3 + std::cos(lat))};
    });
}
// Numbers over many magnitudes, some of them 0.
Raster rough(uint32_t width, uint32_t height, uint64_t seed)
{
    Random random(seed);
    return make_raster(width, height, [&](uint32_t, uint32_t) {
        const bool lit = random.below(3) > 0;
        const auto c = static_cast<float>(std::abs(random.log_uniform(-3, 3)));
        return lit ? Color{c, c * 0.5f, c * 2} : Color{};
    });
}
Raster sun(uint32_t width, uint32_t height, uint32_t column, uint32_t row, float sky = 0)
{
    return make_raster(width, height, [=](uint32_t x, uint32_t y) {
        const float c = x == column && y == row ? 1e6f : sky;
        return Color{c, c, c};
    });
}

// By the convention: the middle of texel (x, y), as a direction of the unrotated picture.
Vec3d middle(const EnvironmentMap& m, double x, double y)
{
    const double lon = pi_d - 2 * pi_d * (x + 0.5) / m.width(), lat = pi_d / 2 - pi_d * (y + 0.5) / m.height();
    return {std::sin(lon) * std::cos(lat), std::sin(lat), std::cos(lon) * std::cos(lat)};
}

// The picture in quarters of texels, in each of which the density is linear in the longitude and in the cosine of the
// polar angle: the value in its middle is its mean.
struct Quarter {
    Vec3d middle;
    double solid_angle;
};
double quarter_border(const EnvironmentMap& m, uint32_t row) { return std::cos(pi_d * row / (2 * m.height())); }
std::vector<Quarter> quarters(const EnvironmentMap& m)
{
    std::vector<Quarter> all;
    for (uint32_t y = 0; y < 2 * m.height(); ++y)
        for (uint32_t x = 0; x < 2 * m.width(); ++x) {
            const double top = quarter_border(m, y), bottom = quarter_border(m, y + 1), z = (top + bottom) / 2;
            const double lon = pi_d - pi_d * (x + 0.5) / m.width(), r = std::sqrt(1 - z * z);
            all.push_back({{std::sin(lon) * r, z, std::cos(lon) * r}, pi_d / m.width() * (top - bottom)});
        }
    return all;
}

struct NamedMap {
    std::string name;
    Raster raster;
    Vec3d rotate_deg;
};
std::vector<NamedMap> maps()
{
    std::vector<NamedMap> all;
    const Vec3d turned{20, -130, 70};
    for (const Vec3d& r : {Vec3d{}, turned}) {
        const std::string suffix = r == turned ? ", turned" : "";
        all.push_back({"smooth" + suffix, smooth(24, 12), r});
        all.push_back({"rough" + suffix, rough(25, 13, 1), r});
        all.push_back({"sun" + suffix, sun(32, 16, 5, 3), r});
        all.push_back({"sun and sky" + suffix, sun(32, 16, 31, 9, 1), r});
        all.push_back({"sun at the pole" + suffix, sun(32, 16, 7, 0, 1), r});
        all.push_back({"one texel" + suffix, smooth(1, 1), r});
        all.push_back({"one column" + suffix, rough(1, 7, 2), r});
        all.push_back({"one row" + suffix, rough(9, 1, 3), r});
    }
    return all;
}

TEST(EnvironmentMap, AxesAreWhereOpenExrHasThem)
{
    // 8 patches of width 8 in each row of 3; a number for each.
    const Raster r = make_raster(64, 32, [](uint32_t x, uint32_t y) {
        const uint32_t band = y < 4 ? 0 : y < 28 ? 1 : 2;
        const float column = static_cast<float>((x + 4) % 64 / 8);
        return band == 1 ? Color{column, 0, 0} : Color{0, static_cast<float>(band) + 1, 0};
    });
    const EnvironmentMap m = make_map(r);
    EXPECT_EQ(m.eval({0, 0, 1}), (Color{4, 0, 0})) << "+z: the centre";
    EXPECT_EQ(m.eval({1, 0, 0}), (Color{2, 0, 0})) << "+x: a quarter from the left";
    EXPECT_EQ(m.eval({-1, 0, 0}), (Color{6, 0, 0})) << "-x: a quarter from the right";
    EXPECT_EQ(m.eval({0, 0, -1}), (Color{0, 0, 0})) << "-z: the edges";
    EXPECT_EQ(m.eval({0, 1, 0}), (Color{0, 1, 0})) << "+y: the top";
    EXPECT_EQ(m.eval({0, -1, 0}), (Color{0, 3, 0})) << "-y: the bottom";
    EXPECT_EQ(m.eval(normalize(Vec3{1, 0, 1})), (Color{3, 0, 0}));
    EXPECT_EQ(m.eval(normalize(Vec3{-1, 0.2f, -1})), (Color{7, 0, 0}));
    // A quarter turn about y takes +z to +x, one about x takes +y to +z.
    EXPECT_EQ(make_map(r, {0, 90, 0}).eval({1, 0, 0}), (Color{4, 0, 0}));
    EXPECT_EQ(make_map(r, {90, 0, 0}).eval({0, 0, 1}), (Color{0, 1, 0}));
}

TEST(EnvironmentMap, TexelsInTheirMiddlesAndRampsBetween)
{
    const Raster r = rough(6, 5, 4);
    const EnvironmentMap m = make_map(r);
    const auto texel = [&](uint32_t x, uint32_t y) { return static_cast<double>(r.floats[3 * (y * 6 + x)]); };
    const auto at = [&](double x, double y) { return static_cast<double>(m.eval(to_float(middle(m, x, y))).r); };
    const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-3 * std::max(a, b) + 1e-3; };
    for (uint32_t y = 0; y < 5; ++y)
        for (uint32_t x = 0; x < 6; ++x) {
            EXPECT_TRUE(near(at(x, y), texel(x, y))) << x << y;
            // Half way to the right, over the seam too; a quarter of the way down, flat beyond the last middles.
            EXPECT_TRUE(near(at(x + 0.5, y), (texel(x, y) + texel((x + 1) % 6, y)) / 2)) << x << y;
            const double below = y < 4 ? texel(x, y + 1) : texel(x, y), above = y > 0 ? texel(x, y - 1) : texel(x, y);
            EXPECT_TRUE(near(at(x, y + 0.25), 0.75 * texel(x, y) + 0.25 * below)) << x << y;
            EXPECT_TRUE(near(at(x, y - 0.25), 0.75 * texel(x, y) + 0.25 * above)) << x << y;
        }
}

TEST(EnvironmentMap, TurnsAsAWhole)
{
    const Vec3d angles{20, -130, 70};
    const EnvironmentMap still = make_map(smooth(64, 32)), turned = make_map(smooth(64, 32), angles);
    const Transform t = make_transform({}, angles, {1, 1, 1});
    Random random(5);
    EXPECT_EQ(still.power(), turned.power());
    for (int i = 0; i < 1000; ++i) {
        const Vec3d d = random.direction();
        const Color a = still.eval(to_float(d)), b = turned.eval(to_float(t.vector(d)));
        ASSERT_NEAR(a.r, b.r, 1e-5) << i;
        ASSERT_NEAR(a.b, b.b, 1e-5) << i;
        const Vec2 u = random.unit2();
        const EnvironmentSample s = still.sample(u), r = turned.sample(u);
        ASSERT_LE(length(t.vector(to_double(s.wi)) - to_double(r.wi)), 1e-6);
        ASSERT_NEAR(s.pdf / r.pdf, 1, 1e-5);
    }
}

// Those of maps(), sampled as a whole and above half their mean.
template <class F>
void for_each_map(const F& f)
{
    for (const auto& [name, raster, rotate_deg] : maps())
        for (const double compensation : {0.0, 0.5}) {
            const EnvironmentMap m = make_map(raster, rotate_deg, {}, compensation);
            ASSERT_TRUE(m.is_sampled()) << name;
            f(name + (compensation > 0 ? ", compensated" : ""), m, rotate_deg);
        }
}

TEST(EnvironmentMap, DensityIntegratesToOne)
{
    for_each_map([&](const std::string& name, const EnvironmentMap& m, Vec3d rotate_deg) {
        const Transform t = make_transform({}, rotate_deg, {1, 1, 1});
        double sum = 0;
        for (const Quarter& q : quarters(m))
            sum += q.solid_angle * static_cast<double>(m.pdf(to_float(t.vector(q.middle))));
        EXPECT_NEAR(sum, 1, 1e-6) << name;
    });
}

TEST(EnvironmentMap, SamplesHaveTheDensityAndRadianceOfTheirDirection)
{
    for_each_map([&](const std::string& name, const EnvironmentMap& m, Vec3d) {
        Random random(6);
        for (int i = 0; i < 20000; ++i) {
            Vec2 u = random.unit2();
            if (i % 7 == 0) u.x = i % 2 ? 0 : 1 - 0x1p-24f;
            if (i % 11 == 0) u.y = i % 2 ? 0 : 1 - 0x1p-24f;
            const EnvironmentSample s = m.sample(u);
            ASSERT_NEAR(length(s.wi), 1, gamma(8)) << name;
            // At the ends of the tables rounding may turn a direction to where nothing is sampled.
            const bool at_an_end = i % 7 == 0 || i % 11 == 0;
            ASSERT_TRUE(s.pdf > 0 || is_black(s.radiance) || at_an_end) << name;
            ASSERT_EQ(s.pdf, m.pdf(s.wi)) << name << u.x << " " << u.y;
            ASSERT_EQ(s.radiance, m.eval(s.wi)) << name;
        }
    });
}

TEST(EnvironmentMap, SamplesFollowTheDensity)
{
    stats::Family family;
    Random random(7);
    for_each_map([&](const std::string& name, const EnvironmentMap& m, Vec3d rotate_deg) {
        const Transform t = make_transform({}, rotate_deg, {1, 1, 1});
        constexpr uint32_t count = 100000;
        const uint32_t columns = 2 * m.width(), rows = 2 * m.height();
        std::vector<double> expected;
        for (const Quarter& q : quarters(m))
            expected.push_back(count * q.solid_angle * static_cast<double>(m.pdf(to_float(t.vector(q.middle)))));
        std::vector<uint64_t> observed(expected.size());
        for (uint32_t i = 0; i < count; ++i) {
            const Vec3d d = t.normal_by_inverse(to_double(m.sample(random.unit2()).wi));
            const double across = 0.5 - std::atan2(d.x, d.z) / (2 * pi_d);
            const auto column = std::min(static_cast<uint32_t>(across * columns), columns - 1);
            uint32_t row = 0;
            while (row + 1 < rows && d.y < quarter_border(m, row + 1)) ++row;
            ++observed[size_t{row} * columns + column];
        }
        family.add(chi_square_test(observed, expected).p, name);
    });
}

// Light sampling takes what exceeds the threshold and nothing else; of a constant picture it takes nothing.
TEST(EnvironmentMap, LeavesWhatIsDarkerThanItsMeanToBsdfSampling)
{
    const EnvironmentMap sunny = make_map(sun(64, 32, 20, 16, 1e3f), {}, {0.1f, 0.1f, 0.1f}, 2);
    ASSERT_TRUE(sunny.is_sampled());
    const double mean = make_map(sun(64, 32, 20, 16, 1e3f), {}, {0.1f, 0.1f, 0.1f}).power() / (4 * pi_d);
    Random random(8);
    uint32_t dark = 0, bright = 0;
    for (int i = 0; i < 100000; ++i) {
        const Vec3 w = random.unit_vector();
        const Color c = sunny.eval(w);
        const double y = luminance(double{c.r}, double{c.g}, double{c.b});
        if (y > 2 * mean) {
            ++bright;
            ASSERT_GT(sunny.pdf(w), 0);
        }
        if (sunny.pdf(w) == 0) ++dark;
    }
    EXPECT_GT(dark, 90000u);
    EXPECT_GT(bright, 20u);
    const Raster even = make_raster(8, 4, [](uint32_t, uint32_t) { return Color{1, 2, 3}; });
    EXPECT_FALSE(make_map(even, {}, {}, 2).is_sampled());
    EXPECT_FALSE(make_map(even, {}, {}, 2).is_black());
    EXPECT_EQ(make_map(even, {}, {}, 2).pdf({0, 1, 0}), 0);
}

TEST(EnvironmentMap, PowerIsTheIntegralOfLuminance)
{
    const auto constant = make_map(make_raster(37, 19, [](uint32_t, uint32_t) { return Color{2, 3, 5}; }));
    EXPECT_NEAR(constant.power() / (4 * pi_d * luminance(2, 3, 5)), 1, 1e-12);
    // What a sample of the luminance weighs is the same for all of them, but for the change of the cosine in a cell.
    for (const bool with_sun : {false, true}) {
        const EnvironmentMap m = make_map(with_sun ? sun(256, 128, 50, 40, 1) : rough(256, 128, 1));
        stats::Tally sum;
        Random random(8);
        for (int i = 0; i < 100000; ++i) {
            const EnvironmentSample s = m.sample(random.unit2());
            sum.add(static_cast<double>(luminance(s.radiance) / s.pdf));
        }
        EXPECT_NEAR(sum.mean / m.power(), 1, 1e-3) << with_sun;
        EXPECT_LT(std::sqrt(sum.variance()), 0.02 * sum.mean) << with_sun;
    }
}

// However little: what shines can be drawn.
TEST(EnvironmentMap, WhateverShinesHasADensity)
{
    for (const uint32_t column : {0u, 3u, 7u})
        for (const uint32_t row : {0u, 2u, 4u}) {
            const EnvironmentMap m = make_map(make_raster(8, 5, [=](uint32_t x, uint32_t y) {
                return x == column && y == row ? Color{0, 0, 1e-20f} : Color{};
            }));
            Random random(9);
            int lit = 0;
            for (int i = 0; i < 20000; ++i) {
                const Vec3 w = random.unit_vector();
                lit += !is_black(m.eval(w));
                ASSERT_TRUE(is_black(m.eval(w)) || m.pdf(w) > 0) << column << row;
            }
            EXPECT_GT(lit, 100);
        }
}

// The sky beside a sun takes a millionth of the samples, 16 of the 2^24 that u can be: yet all its rows get theirs.
TEST(EnvironmentMap, RareRowsAreDrawnEvenly)
{
    const EnvironmentMap m = make_map(sun(64, 32, 20, 31, 2e-5f));
    Random random(10);
    std::vector<uint64_t> observed(30);
    std::vector<double> expected(30);
    uint64_t count = 0;
    for (int i = 0; i < 400000; ++i) {
        const EnvironmentSample s = m.sample({static_cast<float>(i % 64) * 0x1p-24f, random.unit()});
        const auto row =
            static_cast<uint32_t>(std::acos(std::clamp(static_cast<double>(s.wi.y), -1.0, 1.0)) / pi_d * 32);
        if (row < 30) ++observed[row], ++count;
    }
    const auto angle = [](uint32_t row) { return std::cos(pi_d * row / 32) - std::cos(pi_d * (row + 1) / 32); };
    double total = 0;
    for (uint32_t row = 0; row < 30; ++row) total += angle(row);
    for (uint32_t row = 0; row < 30; ++row) expected[row] = static_cast<double>(count) * angle(row) / total;
    EXPECT_GT(count, 1000u);
    EXPECT_GT(chi_square_test(observed, expected).p, claim_level);
}

TEST(EnvironmentMap, TexelsThatCannotShineAreBlackAndCounted)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const std::array<Color, 6> texels{Color{-1, 2, 3},    Color{nan, 1, 1}, Color{1, inf, 1},
                                      Color{3e38f, 1, 1}, Color{0, 0, 0},   Color{1, 1, 1}};
    Raster r = make_raster(6, 1, [&](uint32_t x, uint32_t) { return texels[x]; });
    const EnvironmentMap m{std::make_shared<const Raster>(r), {10, 10, 10}, {1, 1, 1}, {}};
    EXPECT_EQ(m.bad_texels(), 4u);
    const std::array<Color, 6> expected{Color{1, 21, 31}, Color{1, 1, 1}, Color{1, 1, 1},
                                        Color{1, 1, 1},   Color{1, 1, 1}, Color{11, 11, 11}};
    for (uint32_t x = 0; x < 6; ++x) {
        const Color c = m.eval(to_float(middle(m, x, 0)));
        EXPECT_NEAR(c.r, expected[x].r, 1e-4) << x;
        EXPECT_NEAR(c.g, expected[x].g, 1e-4) << x;
        EXPECT_NEAR(c.b, expected[x].b, 1e-4) << x;
    }
}

TEST(EnvironmentMap, TakesEveryKindOfPicture)
{
    const auto value = [](Raster r) { return make_map(std::move(r)).eval({0, 1, 0}); };
    const auto grey = static_cast<float>(linear_from_srgb(51 / 255.0));
    EXPECT_EQ(value({.width = 1, .height = 1, .channels = 1, .bytes = {51}, .floats = {}}), (Color{grey, grey, grey}));
    EXPECT_EQ(value({.width = 1, .height = 1, .channels = 2, .bytes = {51, 9}, .floats = {}}),
              (Color{grey, grey, grey}));
    EXPECT_EQ(value({.width = 1, .height = 1, .channels = 4, .bytes = {51, 255, 0, 7}, .floats = {}}),
              (Color{grey, 1, 0}));
    const Color sixteen = value({.width = 1, .height = 1, .channels = 3, .bytes = {}, .floats = {0.2f, 1, 0}});
    EXPECT_NEAR(sixteen.r, grey, 1e-6);
    EXPECT_EQ(sixteen.g, 1);
}

// As a scene has it.

TEST(Environment, ConstantsAddUpAndJoinTheMap)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 1));
    d.lights = {sky_of({1, 2, 3}), sky_of({0.5f, 0.5f, 0.5f})};
    EXPECT_EQ(build_scene(d).radiance_from({0, 1, 0}), (Color{1.5f, 2.5f, 3.5f}));
    d.lights.push_back(sky_map_of({2, 2, 2}));
    const Scene s = build_scene(d, picture_source(make_raster(4, 2, [](uint32_t, uint32_t) {
                                    return Color{1, 1, 2};
                                })));
    EXPECT_EQ(s.radiance_from({0, 1, 0}), (Color{3.5f, 4.5f, 7.5f}));
    EXPECT_TRUE(s.lights.lights.empty()) << "constant: left to BSDF sampling";
    d.render.mis_compensation = false;
    ASSERT_EQ(build_scene(d, picture_source(make_raster(4, 2,
                                                        [](uint32_t, uint32_t) {
                                                            return Color{1, 1, 2};
                                                        })))
                  .lights.lights.size(),
              1u);
}

std::string error_of(const SceneDescription& d, const RasterSource& images)
{
    try {
        build_scene(d, images);
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

TEST(Environment, OneThatCannotBeReadOrASecondIsAnError)
{
    SceneDescription d;
    d.spheres.push_back(sphere_of({0, 0, 0}, 1));
    d.lights = {sky_map_of({1, 1, 1}, {}, {"s.toml", 4, 1})};
    EXPECT_EQ(error_of(d, {}), "s.toml:4:1: error: environment not read: nothing reads pictures here");
    const RasterSource broken = [](const std::string& file) {
        std::promise<std::shared_ptr<const Raster>> p;
        p.set_exception(std::make_exception_ptr(Error(ErrorKind::missing_input, file + ": no such file")));
        return p.get_future().share();
    };
    EXPECT_EQ(error_of(d, broken), "s.toml:4:1: error: environment not read: sky: no such file");
    d.lights.push_back(sky_map_of({1, 1, 1}, {}, {"s.toml", 8, 1}));
    EXPECT_EQ(error_of(d, broken),
              "s.toml:8:1: error: a second environment with a file; the first stands at s.toml:4:1");
}

TEST(Environment, WarnsOfBadTexelsAndOfDarkness)
{
    SceneDescription d;
    d.file = "s.toml";
    d.spheres.push_back(sphere_of({0, 0, 0}, 1));
    d.lights = {sky_map_of({1, 1, 1}, {}, {"s.toml", 4, 1})};
    Diagnostics diagnostics;
    const Scene s =
        Scene::build(d, d.render, diagnostics,
                     picture_source(make_raster(4, 2, [](uint32_t x, uint32_t) { return Color{x < 2 ? 0.f : -1.f}; })));
    std::vector<std::string> warnings;
    for (const auto& w : diagnostics.warnings()) warnings.push_back(to_string(w));
    EXPECT_THAT(
        warnings,
        testing::ElementsAre(
            "s.toml:4:1: warning: a texel of the environment is negative or not finite: taken for black (4 times)",
            "s.toml: warning: nothing emits light: the picture will be black"));
    EXPECT_EQ(s.environment_light, Scene::none);
    EXPECT_EQ(s.radiance_from({0, 1, 0}), Color{});
}

}  // namespace
}  // namespace lancer
