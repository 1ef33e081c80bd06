// Pixels that end early: their means stay what they are, their bits do not depend on how the work is cut up, and the
// work grows less. Both rules, and the clamp of the past.
#include <gtest/gtest.h>

#include "support/shoot.h"

namespace lancer {
namespace {

Pixel with_sample(Pixel p, Color c)
{
    const double y = static_cast<double>(luminance(c));
    p += {{static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)}, y * y, 1};
    return p;
}

TEST(StopRules, ConfidenceComesFromTheVarianceOfThePilot)
{
    Pixel pilot;
    for (int i = 0; i < 16; ++i) pilot = with_sample(pilot, i % 2 ? Color{2, 2, 2} : Color{});
    // Mean 1, variance 16 / 15; the half-width of n samples is t sqrt(variance / n).
    for (const double error : {0.3, 0.1, 0.01}) {
        const double needed = 2.131449546 * 2.131449546 * (16.0 / 15) / (error * error * 1.01);
        const uint32_t n = samples_for(pilot, error);
        EXPECT_EQ(n % 16, 0u);
        EXPECT_GE(n, needed);
        EXPECT_LT(n - 16, needed);
    }
    Pixel flat;
    for (int i = 0; i < 16; ++i) flat = with_sample(flat, {0.25f, 0.25f, 0.25f});
    EXPECT_EQ(samples_for(flat, 1e-6), 16u);
    EXPECT_EQ(samples_for(pilot, 1e-9), UINT32_MAX);
    pilot.n = 15;  // one was not finite
    EXPECT_EQ(samples_for(pilot, 0.3), UINT32_MAX);
}

// Ends with the fifth sample at the earliest, and the more easily the later.
TEST(StopRules, TheLastSampleIsComparedWithTheMean)
{
    const auto ends_at = [](const std::vector<Color>& samples) {
        Pixel p;
        for (const Color c : samples) {
            p = with_sample(p, c);
            if (ends_with(p, c)) return p.n;
        }
        return 0u;
    };
    const auto grey = [](float x) { return Color{x, x, x}; };
    EXPECT_EQ(ends_at(std::vector<Color>(9, grey(0.5f))), 5u);
    // The mean of five is 0.6 and 0.024 off the last, or 0.026: the limit is 0.025.
    EXPECT_EQ(ends_at({grey(0.606f), grey(0.606f), grey(0.606f), grey(0.606f), grey(0.576f)}), 5u);
    EXPECT_EQ(ends_at({grey(0.6065f), grey(0.6065f), grey(0.6065f), grey(0.6065f), grey(0.574f)}), 0u);
    // The channel that is furthest off decides.
    EXPECT_EQ(ends_at({grey(0.5f), grey(0.5f), grey(0.5f), grey(0.5f), {0.5f, 0.5f, 0.9f}, grey(0.5f)}), 0u);
    // 0 and 1 in turn: the 99th is 49/99 off, just below the 0.495 that are allowed.
    std::vector<Color> turns;
    for (int i = 0; i < 200; ++i) turns.push_back(grey(i % 2 ? 1.0f : 0.0f));
    EXPECT_EQ(ends_at(turns), 99u);
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    Pixel five;
    for (int i = 0; i < 5; ++i) five = with_sample(five, grey(0.5f));
    EXPECT_FALSE(ends_with(five, grey(none)));
}

// Only the classic integrators have the rule and the clamp of the past.
TEST(StopRules, ThoseOfThePastAreForTheClassicIntegrators)
{
    for (const bool legacy : {false, true})
        for (const bool stop : {false, true})
            for (const std::string_view name : enum_names<IntegratorKind>) {
                const RenderSettings s{
                    .integrator = value_of<IntegratorKind>(name).value(), .stop = stop, .legacy = legacy};
                const bool classic = legacy && name.size() > 6;
                EXPECT_EQ(clamps_samples(s), classic) << name;
                EXPECT_EQ(stop_rule(s), !stop     ? StopRule::never
                                        : classic ? StopRule::last_sample
                                                  : StopRule::confidence)
                    << name;
            }
}

// White bars, a twentieth of a pixel wide, one before each column of pixels: most pilots see little of them.
SceneDescription thin_bars()
{
    SceneDescription d;
    d.materials = {make_emitter("bar", {1, 1, 1})};
    for (int i = 0; i < 8; ++i) {
        const double x = (i - 3.5) / 4 + 0.02;
        d.meshes.push_back(make_mesh(make_quad({x - 0.00625, -1, 0}, {x + 0.00625, -1, 0}, {x + 0.00625, 1, 0},
                                               {x - 0.00625, 1, 0}, make_emitter("bar", {1, 1, 1}))));
    }
    d.materials.clear();
    d.camera = make_camera({0, 0, 10}, {0, 0, 0}, 2 * std::atan(0.1) * 180 / pi_d);
    return d;
}

RendererConfig settings_of(StopRule rule, double error, uint64_t seed, SamplerKind sampler)
{
    RendererConfig s;
    s.kernel.stop = rule;
    s.kernel.stop_error = error;
    s.kernel.seed = salted(seed);
    s.kernel.sampler = sampler;
    s.kernel.filter = Filter(FilterKind::box);
    return s;
}

double mean_of(const Film& film)
{
    double sum = 0;
    for (const Pixel& p : film.pixels) sum += tally(p).mean;
    return sum / static_cast<double>(film.pixels.size());
}

// Over many seeds the mean is the one without stopping. A rule that looks at the samples which it averages is far off
// on the same picture, so that the test can tell.
TEST(StopRules, ConfidenceDoesNotMoveTheMean)
{
    const SceneDescription d = thin_bars();
    stats::Family unbiased;
    for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol}) {
        stats::Tally full, stopped, naive;
        uint64_t traced = 0;
        for (uint64_t seed = 0; seed < 300; ++seed) {
            RenderRequest r;
            r.width = 8, r.height = 8, r.spp = {16, 112}, r.threads = 2;
            r.settings = settings_of(StopRule::never, 0.2, 2 * seed, sampler);
            full.add(mean_of(render(d, r).film));
            r.settings = settings_of(StopRule::confidence, 0.2, 2 * seed + 1, sampler);
            const Rendered early = render(d, r);
            stopped.add(mean_of(early.film));
            traced += early.counters.camera_rays + early.counters.background_only_samples;

            r.settings.kernel.stop = StopRule::never;
            const Film all = render(d, r).film;
            r.spp = {16};
            const Film first = render(d, r).film;
            double sum = 0;
            for (size_t i = 0; i < first.pixels.size(); ++i)
                sum += tally(samples_for(first.pixels[i], 0.2) <= 16 ? first.pixels[i] : all.pixels[i]).mean;
            naive.add(sum / 64);
        }
        unbiased.add(stats::welch_p(full, stopped), "stopped against full");
        EXPECT_LT(stats::welch_p(full, naive), 1e-9) << "mean " << full.mean << ", naive " << naive.mean;
        EXPECT_NEAR(full.mean, 0.05, 0.002);
        EXPECT_LT(4 * std::hypot(full.error(), stopped.error()), 0.05 * full.mean) << "too noisy to tell";
        EXPECT_LT(traced, uint64_t{300} * 64 * 128) << "no pixel ended early";
    }
}

// A pixel that has ended has the bits of a picture of so many samples.
TEST(StopRules, APixelThatEndsIsThatOfAShorterRender)
{
    const SceneDescription d = cornell_scene();
    RenderRequest r;
    r.width = 16, r.height = 12, r.spp = {96};
    r.settings = settings_of(StopRule::confidence, 0.1, 0, SamplerKind::sobol);
    const Film early = render(d, r).film;
    r.settings.kernel.stop = StopRule::never;
    std::vector<size_t> ended;
    for (uint32_t n = 16; n <= 96; n += 16) {
        r.spp = {n};
        const Film all = render(d, r).film;
        ended.push_back(0);
        for (size_t i = 0; i < all.pixels.size(); ++i) {
            if (early.pixels[i].n != n) continue;
            ++ended.back();
            EXPECT_EQ(early.pixels[i].sum, all.pixels[i].sum);
            EXPECT_EQ(early.wanted[i] >= 96 ? 96 : early.wanted[i], n);
        }
    }
    EXPECT_EQ(std::accumulate(ended.begin(), ended.end(), size_t{0}), early.pixels.size());
    EXPECT_GT(ended.front(), 5u);
    EXPECT_GT(ended.back(), 5u);
    EXPECT_EQ(samples_wanted(early, 96), [&] {
        uint64_t n = 0;
        for (const Pixel& p : early.pixels) n += p.n;
        return n;
    }());
}

TEST(StopRules, WhatNeedsNoSamplesCostsNone)
{
    SceneDescription d = cornell_scene();
    d.camera->position = {0, 0, 12};  // mostly nothing
    RenderRequest r;
    r.spp = {256};
    const auto samples = [&] {
        const Counters c = render(d, r).counters;
        return c.camera_rays + c.background_only_samples;
    };
    const uint64_t all = samples();
    r.settings = settings_of(StopRule::confidence, 0.05, 0, SamplerKind::sobol);
    EXPECT_LT(4 * samples(), all);
    r.settings.kernel.stop = StopRule::last_sample;
    EXPECT_LT(4 * samples(), all);
}

// The rule of the past, sample by sample, told by hand.
TEST(StopRules, TheLastSampleEndsThePixel)
{
    const SceneDescription d = cornell_scene();
    RenderRequest r;
    r.width = 6, r.height = 5, r.spp = {16, 32}, r.aovs = all_aovs();
    r.settings = settings_of(StopRule::last_sample, 0, 3, SamplerKind::sobol);
    r.settings.kernel.clamp = true;
    const Film film = render(d, r).film;
    const Renderer renderer(build_scene(d), r.settings);
    const Camera camera = camera_of(d, renderer.scene(), r.width, r.height);
    const PathListener deaf{.ray = [](const PathState&, const Hit&) {},
                            .vertex = [](const PathState&, const Surface&) {},
                            .added = [](const PathState&, Color) {},
                            .shadow = [](const Ray&, Color, bool) {}};
    uint32_t fewest = 48, most = 0;
    for (uint32_t y = 0; y < 5; ++y)
        for (uint32_t x = 0; x < 6; ++x) {
            Pixel p;
            bool ended = false;
            for (uint32_t block = 0; block < 3 && !ended; ++block) {
                Pixel part;
                const Pixel before = p;
                for (uint32_t i = 0; i < 16 && !ended; ++i) {
                    const Color c = renderer.replay(camera, r.width, r.height, {x, y, block * 16 + i}, deaf);
                    EXPECT_LE(std::max({c.r, c.g, c.b}), 1);
                    part = with_sample(part, c);
                    p = before;
                    p += part;
                    ended = ends_with(p, c);
                }
            }
            const Pixel& q = film.at(x, y);
            EXPECT_EQ(q.n, p.n) << x << " " << y;
            EXPECT_EQ(q.sum, p.sum) << x << " " << y;
            EXPECT_EQ(film.whole_aov(film.index(x, y), film.aov_layout.offset(AovSum::samples)), q.n);
            fewest = std::min(fewest, q.n), most = std::max(most, q.n);
        }
    EXPECT_GE(fewest, 5u);
    EXPECT_GT(most, fewest);
}

struct StopCase {
    size_t scene;
    AnyIntegrator integrator;
    StopRule rule;
};
std::vector<StopCase> stop_cases()
{
    std::vector<StopCase> cases;
    const size_t scenes = test_scenes().size();
    for (size_t i = 0; i < scenes; ++i)
        for (const AnyIntegrator& integrator : all_integrators())
            for (const StopRule rule : {StopRule::confidence, StopRule::last_sample})
                cases.push_back({i, integrator, rule});
    return cases;
}
class Stopped : public testing::TestWithParam<StopCase> {};
INSTANTIATE_TEST_SUITE_P(Every, Stopped, testing::ValuesIn(stop_cases()), [](const auto& c) {
    std::string name = std::string(test_scenes()[c.param.scene].name) + "_" +
                       std::visit([](const auto& i) { return std::string(name_of(i.kind)); }, c.param.integrator) +
                       (c.param.rule == StopRule::confidence ? "_confidence" : "_last");
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST_P(Stopped, SamePixelsHoweverTheWorkIsCutUp)
{
    const SceneDescription scene = test_scenes()[GetParam().scene].make();
    RenderRequest r;
    r.width = 12, r.height = 9, r.tile = 5, r.spp = {64};
    r.settings = settings_of(GetParam().rule, 0.25, 0, SamplerKind::sobol);
    r.settings.integrator = GetParam().integrator;
    const Film usual = render(scene, r).film;
    const auto expect_same = [&](const RenderRequest& request, const char* what) {
        const Film f = render(scene, request).film;
        EXPECT_EQ(usual.wanted, f.wanted) << what;
        EXPECT_TRUE(same_bits(usual, f)) << what;
    };
    RenderRequest other = r;
    other.threads = 3;
    expect_same(other, "threads");
    other = r;
    other.tile = 12;
    expect_same(other, "tiles");
    other = r;
    other.settings.kernel.batch = 7;
    expect_same(other, "batches");
    other = r;
    other.spp = {16, 48};
    expect_same(other, "two passes");
    other.spp = {32, 16, 16};
    expect_same(other, "three passes");
    other = r;
    other.aovs = all_aovs();
    expect_same(other, "aovs");
    r.crop = {3, 2, 9, 8};
    const Film crop = render(scene, r).film;
    uint32_t fewest = 64, most = 0;
    for (uint32_t y = 2; y < 8; ++y)
        for (uint32_t x = 3; x < 9; ++x) {
            EXPECT_EQ(crop.at(x, y).sum, usual.at(x, y).sum);
            EXPECT_EQ(crop.at(x, y).n, usual.at(x, y).n);
        }
    for (const Pixel& p : usual.pixels) fewest = std::min(fewest, p.n), most = std::max(most, p.n);
    EXPECT_LT(fewest, most) << "all pixels alike: nothing was compared";
}

TEST(Clamp, CutsEachSampleNotTheMean)
{
    const SceneDescription d = thin_bars();
    SceneDescription bright = d;
    for (auto& m : bright.meshes) {
        MeshData data = *m.data;
        data.materials[0].emission = {8, 4, 0.5f};
        m.data = std::make_shared<const MeshData>(data);
    }
    RenderRequest r;
    r.width = 8, r.height = 8, r.spp = {64};
    r.settings = settings_of(StopRule::never, 0, 0, SamplerKind::sobol);
    const Film open = render(bright, r).film, unit = render(d, r).film;
    r.settings.kernel.clamp = true;
    const Film cut = render(bright, r).film;
    for (size_t i = 0; i < cut.pixels.size(); ++i) {
        EXPECT_EQ(cut.pixels[i].sum[0], unit.pixels[i].sum[0]);
        EXPECT_EQ(cut.pixels[i].sum[1], unit.pixels[i].sum[1]);
        EXPECT_EQ(cut.pixels[i].sum[2], open.pixels[i].sum[2]);
    }
    EXPECT_LT(mean_of(cut), 0.5 * mean_of(open));
    EXPECT_GT(mean_of(cut), 0);
}

}  // namespace
}  // namespace lancer
