// What a pass promises besides its pixels: dropped samples are counted and named, a stop leaves whole tiles, a replay
// is the sample that was rendered.
#include "render/renderer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <bit>

#include "support/render.h"

namespace lancer {
namespace {

const PathListener deaf{.ray = [](const PathState&, const Hit&) {},
                        .vertex = [](const PathState&, const Surface&) {},
                        .added = [](const PathState&, Color) {},
                        .shadow = [](const Ray&, Color, bool) {}};

TEST(MakeTiles, CoversTheCropOnceAlignedToThePicture)
{
    for (const Tile crop : {Tile{0, 0, 33, 17}, Tile{5, 3, 22, 40}, Tile{16, 16, 32, 32}, Tile{7, 7, 8, 8}})
        for (const uint32_t size : {1u, 8u, 16u, 100u}) {
            std::vector<int> covered(50 * 50);
            for (const Tile& t : make_tiles(crop, size)) {
                EXPECT_EQ(t.x0 / size, (t.x1 - 1) / size);
                EXPECT_EQ(t.y0 / size, (t.y1 - 1) / size);
                for (uint32_t y = t.y0; y < t.y1; ++y)
                    for (uint32_t x = t.x0; x < t.x1; ++x) ++covered[y * 50 + x];
            }
            for (uint32_t y = 0; y < 50; ++y)
                for (uint32_t x = 0; x < 50; ++x) {
                    const bool inside = x >= crop.x0 && x < crop.x1 && y >= crop.y0 && y < crop.y1;
                    ASSERT_EQ(covered[y * 50 + x], inside ? 1 : 0);
                }
        }
    EXPECT_TRUE(make_tiles({4, 4, 4, 9}, 8).empty());
}

TEST(Pass, CountsItsRays)
{
    RenderRequest r;
    const Counters c = render(cornell_scene(), r).counters;
    EXPECT_EQ(c.camera_rays + c.background_only_samples, uint64_t{r.width} * r.height * r.spp[0]);
    EXPECT_GT(c.bounce_rays, c.camera_rays / 2);
    EXPECT_GT(c.shadow_rays, c.camera_rays / 2);
    EXPECT_EQ(c.dropped, 0u);
    EXPECT_FALSE(c.first_dropped);
    r.threads = 5;
    r.tile = 8;
    const Counters d = render(cornell_scene(), r).counters;
    EXPECT_EQ(c.bounce_rays, d.bounce_rays);
    EXPECT_EQ(c.shadow_rays, d.shadow_rays);
}

// A light so strong that what it sends to places near it is more than float holds, while far away it is finite.
SceneDescription dazzling(float intensity)
{
    SceneDescription d;
    d.meshes.push_back(make_mesh(make_quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1})));
    d.lights.push_back({.where = {},
                        .type = LightType::point,
                        .position = {0.3, 0.1, 0.2},
                        .power = {intensity, intensity, intensity}});
    d.camera = make_camera({0, 2.5, 1}, {0, 0, 0}, 50);
    return d;
}

TEST(Pass, DropsCountsAndNamesSamplesThatAreNotFinite)
{
    const SceneDescription description = dazzling(0x1p124f), tame = dazzling(0x1p64f);
    RenderRequest r;
    r.width = 24, r.height = 18;
    const Rendered wild = render(description, r), usual = render(tame, r);
    ASSERT_EQ(usual.counters.dropped, 0u);

    // Which ones, by hand.
    const Renderer renderer(build_scene(description), r.settings);
    const Camera camera = camera_of(description, renderer.scene(), r.width, r.height);
    uint64_t dropped = 0;
    std::optional<SampleId> first;
    for (uint32_t x = 0; x < r.width; ++x)
        for (uint32_t y = 0; y < r.height; ++y) {
            Pixel sum;
            for (uint32_t i = 0; i < r.spp[0]; ++i) {
                const Color c = renderer.replay(camera, r.width, r.height, {x, y, i}, deaf);
                if (is_finite(c)) {
                    const double l = static_cast<double>(luminance(c));
                    sum += {{static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)}, l * l, 1};
                    continue;
                }
                ++dropped;
                if (!first) first = {x, y, i};
            }
            const Pixel& p = wild.film.at(x, y);
            ASSERT_EQ(p.n, sum.n);
            ASSERT_EQ(p.sum, sum.sum);
            for (const double s : p.sum) ASSERT_TRUE(std::isfinite(s));
            // A pixel without such a sample is what it is under a light 2^60 times weaker.
            if (p.n == r.spp[0]) {
                for (size_t c = 0; c < 3; ++c)
                    ASSERT_EQ(p.sum[c], usual.film.at(x, y).sum[c] * 0x1p60) << x << " " << y;
            }
        }
    EXPECT_GT(dropped, 0u);
    EXPECT_LT(dropped, uint64_t{r.width} * r.height * r.spp[0] / 2);
    EXPECT_EQ(wild.counters.dropped, dropped);
    ASSERT_TRUE(wild.counters.first_dropped);
    EXPECT_EQ(*wild.counters.first_dropped, *first);

    r.threads = 5;
    r.tile = 8;
    const Rendered again = render(description, r);
    EXPECT_EQ(again.counters.dropped, dropped);
    EXPECT_EQ(*again.counters.first_dropped, *first);
}

class Stopping : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Threads, Stopping, testing::Values(1u, 2u, 5u));

TEST_P(Stopping, LeavesEachTileWholeOrUntouched)
{
    const SceneDescription d = cornell_scene();
    RenderRequest request;
    request.width = 64, request.height = 48;
    const Film whole = render(d, request).film;
    with_threads(GetParam(), [&] {
        const Renderer renderer(build_scene(d), {});
        const Camera camera = camera_of(d, renderer.scene(), 64, 48);
        const std::vector<Tile> tiles = make_tiles({0, 0, 64, 48}, 8);
        for (const int after : {0, 1, 7}) {
            Film film(64, 48, {0, 0, 64, 48});
            std::stop_source stop;
            if (after == 0) stop.request_stop();
            std::atomic<int> done{0};
            const PassResult result = renderer.pass(camera, film, tiles, {0, 16}, stop.get_token(), [&](const Tile&) {
                if (++done == after) stop.request_stop();
            });
            EXPECT_FALSE(result.is_complete());
            EXPECT_GE(done, after);
            EXPECT_LT(done, after + static_cast<int>(GetParam()) + 1);
            int touched = 0;
            for (const Tile& t : tiles) {
                const bool mine = film.at(t.x0, t.y0).n > 0;
                touched += mine;
                for (uint32_t y = t.y0; y < t.y1; ++y)
                    for (uint32_t x = t.x0; x < t.x1; ++x) {
                        ASSERT_EQ(film.at(x, y).n, mine ? 16u : 0u);
                        ASSERT_TRUE(!mine || film.at(x, y).sum == whole.at(x, y).sum);
                    }
            }
            EXPECT_EQ(touched, done);
            EXPECT_EQ(result.counters.camera_rays + result.counters.background_only_samples,
                      static_cast<uint64_t>(done) * 8 * 8 * 16);
        }
    });
}

// Nothing lacks, so nothing must be said to lack: who believes it would add the samples twice.
TEST_P(Stopping, AfterTheLastTileThePassIsComplete)
{
    const SceneDescription d = cornell_scene();
    with_threads(GetParam(), [&] {
        const Renderer renderer(build_scene(d), {});
        const Camera camera = camera_of(d, renderer.scene(), 32, 24);
        const std::vector<Tile> tiles = make_tiles({0, 0, 32, 24}, 8);
        Film film(32, 24, {0, 0, 32, 24});
        std::stop_source stop;
        std::atomic<size_t> done{0};
        const PassResult result = renderer.pass(camera, film, tiles, {0, 16}, stop.get_token(), [&](const Tile&) {
            if (++done == tiles.size()) stop.request_stop();
        });
        EXPECT_EQ(done, tiles.size());
        EXPECT_TRUE(result.is_complete());
    });
}

// What was left of a pass that was stopped, rendered later, makes the same picture.
TEST_P(Stopping, WhatIsLeftMayFollow)
{
    const SceneDescription d = cornell_scene();
    RenderRequest request;
    request.width = 64, request.height = 48;
    const Film whole = render(d, request).film;
    with_threads(GetParam(), [&] {
        const Renderer renderer(build_scene(d), {});
        const Camera camera = camera_of(d, renderer.scene(), 64, 48);
        Film film(64, 48, {0, 0, 64, 48});
        std::vector<Tile> left = make_tiles({0, 0, 64, 48}, 8);
        Counters counters;
        size_t passes = 0;
        for (; !left.empty(); ++passes) {
            std::stop_source stop;
            std::atomic<int> done{0};
            const PassResult result = renderer.pass(camera, film, left, {0, 16}, stop.get_token(), [&](const Tile&) {
                if (++done == 5) stop.request_stop();
            });
            ASSERT_EQ(result.left.size() + static_cast<size_t>(done), left.size());
            counters += result.counters;
            left = result.left;
        }
        EXPECT_GT(passes, 3u);
        EXPECT_EQ(counters.camera_rays + counters.background_only_samples, uint64_t{64} * 48 * 16);
        for (size_t i = 0; i < film.pixels.size(); ++i) ASSERT_TRUE(film.pixels[i].sum == whole.pixels[i].sum);
    });
}

// Cameras that take turns, from many threads: each is answered by its own plan, which stays what it is when another
// camera is asked about.
TEST(Plan, IsOfTheCameraThatWasAskedAbout)
{
    const SceneDescription d = cornell_scene();
    SceneDescription there = d;
    there.camera->position = {0.6, 0.5, 1.5};
    there.camera->target = {-0.5, -0.5, -0.5};
    with_threads(4, [&] {
        const Renderer renderer(build_scene(d), {});
        const std::array<Camera, 2> cameras{camera_of(d, renderer.scene(), 32, 24),
                                            camera_of(there, renderer.scene(), 32, 24)};
        const auto first = renderer.plan(cameras[0], 32, 24);
        const SamplingPlan before = *first;
        const SamplingPlan other = *renderer.plan(cameras[1], 32, 24);
        ASSERT_FALSE(before.importance == other.importance);
        EXPECT_TRUE(first->importance == before.importance);
        std::atomic<int> wrong{0};
        parallel_for(32, [&](size_t i) {
            const auto plan = renderer.plan(cameras[i % 2], 32, 24);
            wrong += !(plan->importance == (i % 2 ? other : before).importance);
        });
        EXPECT_EQ(wrong, 0);
    });
}

TEST(Replay, IsTheSampleThatTheFilmGot)
{
    for (const NamedScene& s : all_test_scenes())
        for (const AnyIntegrator& integrator : all_integrators()) {
            RenderRequest r;
            r.width = 24, r.height = 18;
            r.spp = {1};
            r.settings.integrator = integrator;
            const Film film = render(s.description, r).film;
            const Renderer renderer(build_scene(s.description), r.settings);
            const Camera camera = camera_of(s.description, renderer.scene(), r.width, r.height);
            double light = 0;
            for (uint32_t y = 0; y < r.height; ++y)
                for (uint32_t x = 0; x < r.width; ++x) {
                    Color added{};
                    PathListener listener = deaf;
                    listener.added = [&](const PathState&, Color c) { added += c; };
                    listener.shadow = [&](const Ray&, Color c, bool occluded) { added += occluded ? Color{} : c; };
                    const Color c = renderer.replay(camera, r.width, r.height, {x, y, 0}, listener);
                    const Pixel& p = film.at(x, y);
                    ASSERT_EQ(static_cast<double>(c.r), p.sum[0]) << s.name << " " << x << " " << y;
                    ASSERT_EQ(static_cast<double>(c.g), p.sum[1]);
                    ASSERT_EQ(static_cast<double>(c.b), p.sum[2]);
                    ASSERT_NEAR(added.g, c.g, 1e-5f * (1 + c.g));  // what the listener heard is all there was
                    light += p.sum[1];
                }
            EXPECT_GT(light, 0);
        }
}

// Later samples too, and of a crop: the address is that of the whole picture.
TEST(Replay, FindsASampleOfALaterPassInACrop)
{
    const SceneDescription d = spheres_scene();
    RenderRequest r;
    r.crop = {10, 9, 14, 12};
    r.spp = {16, 1};
    const Film both = render(d, r).film;
    r.spp = {16};
    const Film before = render(d, r).film;
    const Renderer renderer(build_scene(d), r.settings);
    const Camera camera = camera_of(d, renderer.scene(), r.width, r.height);
    for (uint32_t y = 9; y < 12; ++y)
        for (uint32_t x = 10; x < 14; ++x) {
            const Color c = renderer.replay(camera, r.width, r.height, {x, y, 16}, deaf);
            EXPECT_EQ(before.at(x, y).sum[1] + static_cast<double>(c.g), both.at(x, y).sum[1]);
        }
}

}  // namespace
}  // namespace lancer
