// Light sampling as often as a pilot finds that shadow rays arrive: the mean is that of always, in rooms whose lamp is
// seen from little of them.
#include "integrators/path/light_choice.h"

#include <gtest/gtest.h>

#include "render/estimators/arrivals.h"
#include "support/random.h"
#include "support/scenes/dark_rooms.h"
#include "support/scenes/wide_cases.h"
#include "support/shoot.h"

namespace lancer {
namespace {

Path path_with(bool learned)
{
    Path path{.max_depth = 6};
    path.learned_nee = learned;
    return path;
}

LightChoice rates_of(const SceneDescription& d, AccelKind accel = AccelKind::embree)
{
    LightChoice rates;
    with_threads(1, [&] {
        RendererConfig settings;
        settings.integrator = path_with(true);
        settings.accel = accel;
        const Renderer renderer(build_scene(d), settings);
        rates = renderer.plan(camera_of(d, renderer.scene(), 256, 256), 256, 256)->light_choice;
    });
    return rates;
}

void expect_choices_agree(const SceneDescription& d, double detectable, const std::string& name)
{
    const LightChoice rates = rates_of(d);
    ASSERT_FALSE(rates.empty()) << name;
    std::vector<TilesOverSeeds> two;
    uint64_t seed = 500;
    for (const bool learned : {false, true})
        two.emplace_back(d,
                         Shot{.integrator = path_with(learned), .width = 128, .height = 128, .spp = 2, .seed = ++seed});
    expect_one_mean(std::move(two), {.pictures = 8, .detectable = detectable, .rounding = 1e-5}, name);
}

TEST(LightChoice, LeaveTheMeanOfARoomBehindAWindow) { expect_choices_agree(room_with_hole(0.3), 0.03, "window"); }
TEST(LightChoice, LeaveTheMeanOfARoomBehindACurtain) { expect_choices_agree(room_behind_a_curtain(), 0.03, "curtain"); }
TEST(LightChoice, LeaveTheMeanOfARoomBehindAKeyhole) { expect_choices_agree(room_with_hole(0.2), 0.1, "keyhole"); }
TEST(LightChoice, LeaveTheMeanOfALampThatOnePlaceSees) { expect_choices_agree(room_with_niche(), 0.15, "niche"); }

// Where shadow rays arrive there is nothing to learn, and the picture is that without.
TEST(LightChoice, AreNotLearnedWhereShadowRaysArrive)
{
    EXPECT_TRUE(rates_of(cornell_scene()).empty());
    EXPECT_TRUE(rates_of(spheres_scene()).empty());
    EXPECT_TRUE(rates_of(sky_scene()).empty()) << "a sky that most vertices see";
    const auto drawn = [](bool learned) { return shoot(spheres_scene(), {.integrator = path_with(learned)}); };
    EXPECT_TRUE(same_bits(drawn(false), drawn(true)));
}

TEST(LightChoice, AreTheSameByAnyAccelerator)
{
    const SceneDescription d = room_with_hole(0.3);
    const LightChoice embree = rates_of(d);
    for (const AccelKind accel : {AccelKind::bvh2, AccelKind::bvh8, AccelKind::list8, AccelKind::list}) {
        const LightChoice other = rates_of(d, accel);
        EXPECT_EQ(other.exponents, embree.exponents);
        EXPECT_EQ(other.cumulative, embree.cumulative);
        EXPECT_EQ(other.low.x, embree.low.x);
    }
}

LightTable table_of(const std::vector<double>& powers)
{
    LightTable t;
    t.lights.resize(powers.size(), PointLight{});
    t.pick = Discrete(powers);
    return t;
}

// Vertices on a floor from -1 to 1. Left of the middle nothing arrives, right of it what `light` sends.
std::vector<Arrival> half_lit(uint32_t lights, uint32_t light)
{
    Random random(1);
    std::vector<Arrival> arrivals;
    for (int i = 0; i < 20000; ++i) {
        const auto x = static_cast<float>(random.uniform(-1, 1)), y = static_cast<float>(random.uniform());
        const uint32_t to = random.below(lights);
        const auto pixel = static_cast<uint32_t>(i) % 64;
        arrivals.push_back({{x, y, 0}, {0, 0, 1}, pixel, to, x > 0 && to == light ? 2.0f : 0.0f});
    }
    return arrivals;
}

constexpr PilotCost cost{80000, 40000};  // of these vertices and what else there is

// Where nothing arrives lights are sampled as seldom as allowed, where much does always. What is far away belongs to
// the border, whatever its coordinates.
TEST(LightChoice, RatesFollowWhatArrived)
{
    const LightTable one = table_of({1});
    const LightChoice choice = learn_light_choice(half_lit(1, 0), one, choice_of_pilot(one), cost, Sky::none);
    ASSERT_FALSE(choice.empty());
    EXPECT_FALSE(choice.chooses());
    const auto rate = [&](Vec3 p) { return choice.rate(choice.cell_of(p, {0, 0, 1})); };
    const float least = LightChoice::rate_of(LightChoice::lowest);
    EXPECT_EQ(rate({-0.9f, 0.5f, 0}), least);
    EXPECT_EQ(rate({0.9f, 0.5f, 0}), 1);
    EXPECT_EQ(rate({1e30f, 0.5f, 0}), 1);
    EXPECT_EQ(rate({-1e30f, 0.5f, 0}), least);
    EXPECT_EQ(rate({NAN, NAN, NAN}), rate({-1e30f, -1e30f, -1e30f}));
    EXPECT_TRUE(learn_light_choice({}, one, choice_of_pilot(one), cost, Sky::none).empty());
    const std::vector<Arrival> one_place(100, Arrival{{0, 0, 0}, {0, 0, 1}, 0, 0, 0});
    EXPECT_TRUE(learn_light_choice(one_place, one, choice_of_pilot(one), cost, Sky::none).empty());
}

// The light that arrives is chosen, even if it is the weaker one; the others keep a chance, and what does not shine has
// none.
TEST(LightChoice, ChoosesWhatArrives)
{
    const LightTable three = table_of({100, 1, 0});
    const LightChoice pilot = choice_of_pilot(three);
    ASSERT_TRUE(pilot.chooses());
    EXPECT_GT(pilot.probability(0, 1), 0.25f);
    EXPECT_EQ(pilot.probability(0, 2), 0);
    const LightChoice choice = learn_light_choice(half_lit(2, 1), three, pilot, cost, Sky::none);
    ASSERT_TRUE(choice.chooses());
    const uint32_t cell = choice.cell_of({0.9f, 0.5f, 0}, {0, 0, 1});
    EXPECT_GT(choice.probability(cell, 1), 0.9f);
    EXPECT_GT(choice.probability(cell, 0), 0.05f);
    std::array<uint32_t, 3> chosen{};
    constexpr uint32_t n = 1 << 16;
    for (uint32_t i = 0; i < n; ++i) {
        const auto c = choice.choose(cell, static_cast<float>(i) / n);
        ++chosen[c.option];
        ASSERT_EQ(c.probability, choice.probability(cell, c.option));
    }
    for (uint32_t i = 0; i < 3; ++i) EXPECT_NEAR(chosen[i], n * double{choice.probability(cell, i)}, 1.5) << i;
    EXPECT_TRUE(choice_of_pilot(table_of({1})).empty()) << "nothing to choose from";
}

// A sun that the windowless room of the camera never sees, and a lamp in it: by power nearly all samples go to the sun.
TEST(LightChoice, LeavesTheMeanOfARoomUnderASun)
{
    const SceneDescription d = room_under_a_sun();
    EXPECT_TRUE(rates_of(d).chooses());
    expect_choices_agree(d, 0.1, "sun outside");
}

// Light samples go to the tiles of the sky that the window shows, which differ by place.
TEST(LightChoice, LeavesTheMeanOfRoomsWithAWindow)
{
    for (const auto& [name, d] : rooms_with_window()) {
        EXPECT_TRUE(rates_of(d).has_tiles) << name;
        expect_choices_agree(d, 0.03, name);
    }
}

// Half of the vertices see one tile of the sky, found by some BSDF samples; shadow rays to the sky bring nothing.
TEST(LightChoice, ChoosesTilesThatAreSeen)
{
    const LightTable one = table_of({1});
    std::vector<Arrival> arrivals = half_lit(1, 1);
    Random random(2);
    for (Arrival& a : arrivals)
        if (a.p.x > 0 && random.below(8) == 0) a.tile = 5, a.found = 7, a.pdf = 0.3f;
    EXPECT_FALSE(learn_light_choice(arrivals, one, choice_of_pilot(one), cost, Sky::none).has_tiles);
    const LightChoice choice = learn_light_choice(arrivals, one, choice_of_pilot(one), cost, Sky::pictured);
    ASSERT_TRUE(choice.has_tiles);
    ASSERT_EQ(choice.options(), 1 + SkyTiles::count);
    const Vec3 up{0, 0, 1}, there = SkyTiles::sample(5, {0.5f, 0.5f}), elsewhere = SkyTiles::sample(6, {0.5f, 0.5f});
    const uint32_t bright = choice.cell_of({0.9f, 0.5f, 0}, up), dark = choice.cell_of({-0.9f, 0.5f, 0}, up);
    EXPECT_GT(choice.probability(bright, 1 + 5), 0.8f);
    EXPECT_GT(choice.probability(bright, 0), 0.05f) << "the sky as a whole keeps a chance";
    EXPECT_EQ(choice.pdf_of_tiles(bright, there), choice.probability(bright, 1 + 5) * SkyTiles::pdf);
    EXPECT_EQ(choice.pdf_of_tiles(bright, elsewhere), 0);
    EXPECT_GT(choice.rate(bright), choice.rate(dark));
}

}  // namespace
}  // namespace lancer
