// Auxiliary outputs: the values of a scene that can be told by hand, and that nobody but the asker notices them.
#include "render/aov.h"

#include <gtest/gtest.h>

#include <bit>
#include <numeric>

#include "scene/build/media.h"
#include "support/render.h"

namespace lancer {
namespace {

// The channels that were asked for, and one of the light.
std::vector<ImagePlane> planes_of(const SceneDescription& d, const RenderRequest& r)
{
    const Film film = render(d, r).film;
    std::vector<ImagePlane> planes = aov_planes(film, r.aovs, build_scene(d).normalisation);
    ImagePlane& red = planes.emplace_back();
    red.name = "R";
    for (const Pixel& p : film.pixels) red.values.push_back(p.mean().r);
    return planes;
}

const std::vector<float>& values(const std::vector<ImagePlane>& planes, const std::string& name)
{
    for (const ImagePlane& plane : planes)
        if (plane.name == name) return plane.values;
    ADD_FAILURE() << "no channel " << name;
    return planes.front().values;
}

testing::AssertionResult same(const std::vector<ImagePlane>& a, const std::vector<ImagePlane>& b)
{
    for (size_t i = 0; i < a.size(); ++i)
        for (size_t k = 0; k < a[i].values.size(); ++k)
            if (std::bit_cast<uint32_t>(a[i].values[k]) != std::bit_cast<uint32_t>(b[i].values[k]))
                return testing::AssertionFailure()
                       << a[i].name << " of pixel " << k << ": " << a[i].values[k] << " and " << b[i].values[k];
    return testing::AssertionSuccess();
}

// A wall of two units at z = -3, 4 units away from the camera, that fills the upper half of the picture.
SceneDescription half_a_wall()
{
    SceneDescription d;
    MaterialDescription red;
    red.name = "red";
    red.base_color = {0.5f, 0.25f, 0.125f};
    MeshDescription mesh;
    mesh.data = make_quad({-50, 0, -3}, {50, 0, -3}, {50, 50, -3}, {-50, 50, -3}, red);
    d.meshes.push_back(mesh);
    LightDescription sky;
    sky.type = LightType::environment;
    sky.power = {1, 1, 1};
    d.lights.push_back(sky);
    CameraDescription camera;
    camera.position = {0, 0, 1};
    camera.target = {0, 0, 0};
    camera.fov_deg = 60;
    d.camera = camera;
    return d;
}

TEST(Aovs, TellWhatCanBeTold)
{
    RenderRequest r;
    r.width = 9, r.height = 8, r.aovs = all_aovs();
    r.spp = {32, 7};
    r.settings.kernel.filter = Filter(FilterKind::box);
    const auto planes = planes_of(half_a_wall(), r);
    const double pixel = 2 * std::tan(pi_d / 6) / 8;  // at distance 1
    for (size_t y = 0; y < 8; ++y)
        for (size_t x = 0; x < 9; ++x) {
            const size_t k = y * 9 + x;
            const bool wall = y < 4;
            SCOPED_TRACE(testing::Message() << x << " " << y);
            EXPECT_EQ(values(planes, "mask.A")[k], wall ? 1 : 0);
            EXPECT_EQ(values(planes, "samples.N")[k], 39);
            EXPECT_EQ(values(planes, "albedo.R")[k], wall ? 0.5f : 0);
            EXPECT_EQ(values(planes, "flat.B")[k], wall ? 0.125f : 0);
            EXPECT_EQ(values(planes, "normal.X")[k], 0);
            EXPECT_EQ(values(planes, "normal.Z")[k], wall ? 1 : 0);
            EXPECT_EQ(values(planes, "material.ID")[k] > 0, wall);
            const double px = (double(x) - 4) * pixel * 4, py = (3.5 - double(y)) * pixel * 4;
            EXPECT_NEAR(values(planes, "position.Z")[k], wall ? -3 : 0, 1e-5);
            // Sobol points of 16 samples are no further from the mean of a pixel than a sixteenth of it.
            EXPECT_NEAR(values(planes, "position.X")[k], wall ? px : 0, pixel / 4);
            EXPECT_NEAR(values(planes, "position.Y")[k], wall ? py : 0, pixel / 4);
            EXPECT_NEAR(values(planes, "depth.Z")[k], wall ? std::sqrt(16 + px * px + py * py) : 0, pixel / 2);
        }
}

// The albedo is all light that it scatters, on both sides; the base colour what it reflects.
TEST(Aovs, OfATranslucentSheetCountBothSides)
{
    SceneDescription d = half_a_wall();
    d.meshes[0].data = make_quad({-50, 0, -3}, {50, 0, -3}, {50, 50, -3}, {-50, 50, -3},
                                 make_translucent("leaf", {0.5f, 0.25f, 0.125f}, {0.25f, 0.5f, 0.5f}));
    RenderRequest r;
    r.width = 9, r.height = 8, r.aovs = all_aovs();
    r.settings.kernel.filter = Filter(FilterKind::box);
    const auto planes = planes_of(d, r);
    EXPECT_EQ(values(planes, "albedo.R")[4], 0.75f);
    EXPECT_EQ(values(planes, "albedo.B")[4], 0.625f);
    EXPECT_EQ(values(planes, "flat.R")[4], 0.5f);
    EXPECT_EQ(values(planes, "flat.B")[4], 0.125f);
}

TEST(Aovs, VarianceIsThatOfTheMean)
{
    Film film(1, 1, {0, 0, 1, 1});
    const std::vector<float> samples{1, 2, 4, 5};
    for (const float v : samples) film.pixels[0] += {{v, v, v}, double{v} * v, 1};
    // Sample variance 10 / 3, by n.
    EXPECT_NEAR(aov_planes(film, {Aov::variance}, {})[0].values[0], 10.0 / 3 / 4, 1e-6);
}

class AovsSamePixels : public testing::TestWithParam<size_t> {
protected:
    SceneDescription scene = test_scenes()[GetParam()].make();
    RenderRequest request = [] {
        RenderRequest r;
        r.width = 12, r.height = 9;
        r.spp = {32};
        r.tile = 5;
        r.aovs = all_aovs();
        return r;
    }();
};
INSTANTIATE_TEST_SUITE_P(Every, AovsSamePixels, testing::Range(size_t{0}, test_scenes().size()));

TEST_P(AovsSamePixels, HoweverTheWorkIsCutUp)
{
    const auto usual = planes_of(scene, request);
    RenderRequest r = request;
    r.threads = 3;
    EXPECT_TRUE(same(usual, planes_of(scene, r)));
    r = request;
    r.tile = 12;
    EXPECT_TRUE(same(usual, planes_of(scene, r)));
    r = request;
    r.settings.kernel.batch = 5;
    EXPECT_TRUE(same(usual, planes_of(scene, r)));
    r = request;
    r.spp = {16, 16};
    EXPECT_TRUE(same(usual, planes_of(scene, r)));
    r = request;
    r.settings.accel = AccelKind::list;
    EXPECT_TRUE(same(usual, planes_of(scene, r)));
}

TEST_P(AovsSamePixels, TheLightDoesNotNotice)
{
    const Film with = render(scene, request).film;
    request.aovs = {};
    const Film without = render(scene, request).film;
    ASSERT_FALSE(with.aovs.empty());
    ASSERT_TRUE(without.aovs.empty());
    for (size_t i = 0; i < with.pixels.size(); ++i) {
        EXPECT_EQ(with.whole_aov(i, with.aov_layout.offset(AovSum::samples)), 32);
        EXPECT_EQ(with.pixels[i].sum, without.pixels[i].sum) << i;
        EXPECT_EQ(with.pixels[i].sum_sq, without.pixels[i].sum_sq) << i;
    }
}

// What the camera sees first does not depend on how light is followed: every integrator is compared with the first.
TEST_P(AovsSamePixels, UnderEveryIntegrator)
{
    const auto without_light = [&] {
        auto planes = planes_of(scene, request);
        std::erase_if(planes, [](const ImagePlane& p) { return p.name == "R" || p.name == "variance.V"; });
        return planes;
    };
    const auto first = without_light();
    ASSERT_GE(first.size(), 18u);
    // A medium that scatters is seen where no surface is behind it, by integrators that follow what it scatters.
    const bool scatters = build_scene(scene).scatters;
    for (const AnyIntegrator& integrator : all_integrators()) {
        if (scatters && !std::visit([](const auto& i) { return follows_scattering(i.kind); }, integrator)) continue;
        request.settings.integrator = integrator;
        EXPECT_TRUE(same(first, without_light()))
            << std::visit([](const auto& i) { return name_of(i.kind); }, integrator);
    }
}

TEST(Aovs, ACropHasTheValuesOfTheWhole)
{
    RenderRequest r;
    r.aovs = all_aovs();
    const SceneDescription scene = cornell_scene();
    const Film whole = render(scene, r).film;
    r.crop = {5, 3, 22, 17};
    const Film crop = render(scene, r).film;
    for (uint32_t y = 3; y < 17; ++y)
        for (uint32_t x = 5; x < 22; ++x)
            for (size_t k = 0; k < whole.aov_layout.size(); ++k)
                EXPECT_EQ(whole.whole_aov(whole.index(x, y), k), crop.whole_aov(crop.index(x, y), k)) << k;
}

// Bytes of a pixel that an AOV needs: its own, and counts that it shares with others.
struct Needs {
    size_t own;
    bool samples, hits;
};
Needs needs_of(Aov aov)
{
    switch (aov) {
        case Aov::albedo:
        case Aov::flat:
        case Aov::normal:
            return {24, true, false};
        case Aov::position:
            return {24, false, true};
        case Aov::uv:
            return {16, false, true};
        case Aov::depth:
        case Aov::z:
            return {8, false, true};
        case Aov::mask:
            return {0, true, true};
        case Aov::material:
            return {8, false, false};
        case Aov::variance:
        case Aov::samples:
            return {0, false, false};
    }
    return {};
}

// Each AOV alone, and each with each.
std::vector<std::vector<Aov>> ones_and_pairs()
{
    std::vector<std::vector<Aov>> subsets;
    for (const Aov a : all_aovs())
        for (const Aov b : all_aovs()) {
            if (a == b) subsets.push_back({a});
            if (a < b) subsets.push_back({a, b});
        }
    return subsets;
}

TEST(Aovs, CostNoMoreThanWhatIsAsked)
{
    const auto bytes = [](const std::vector<Aov>& which) {
        Film film(3, 2, {0, 0, 3, 2});
        film.keep_aovs(layout_of(which));
        film.keep_blocks_open();
        EXPECT_EQ(film.aovs.size(), film.open_aovs.size());
        return sizeof(film.aovs[0]) * film.aovs.size() / 6;
    };
    for (const auto& which : ones_and_pairs()) {
        const Needs a = needs_of(which.front()), b = which.size() == 2 ? needs_of(which.back()) : Needs{};
        const size_t counts = size_t{a.samples || b.samples} + size_t{a.hits || b.hits};
        EXPECT_EQ(bytes(which), a.own + b.own + 8 * counts) << static_cast<int>(which.front());
    }
    EXPECT_EQ(bytes(all_aovs()), 152u);
    EXPECT_EQ(bytes({}), 0u);
}

// In passes of any length, so that blocks stay open, against all of them in one pass.
TEST_P(AovsSamePixels, WhicheverAreAsked)
{
    with_threads(1, [&] {
        const Renderer renderer(build_scene(scene, request.images), request.settings);
        const Camera camera = camera_of(scene, renderer.scene(), 6, 5);
        const auto draw = [&](const std::vector<Aov>& which, const std::vector<uint32_t>& ends) {
            Film film(6, 5, {0, 0, 6, 5});
            film.keep_aovs(layout_of(which));
            film.keep_blocks_open();
            uint32_t begin = 0;
            for (const uint32_t end : ends) {
                renderer.pass(camera, film, make_tiles(film.crop, 4), {begin, end});
                begin = end;
            }
            return film;
        };
        const auto planes = [&](const Film& film, const std::vector<Aov>& which) {
            return aov_planes(film, which, renderer.scene().normalisation);
        };
        const Film every = draw(all_aovs(), {39});
        for (const auto& which : ones_and_pairs()) {
            const Film some = draw(which, {5, 13, 30, 39});
            EXPECT_TRUE(same(planes(every, which), planes(some, which)));
            for (size_t i = 0; i < some.pixels.size(); ++i) {
                EXPECT_EQ(some.whole(i).sum, every.whole(i).sum);
                EXPECT_EQ(some.whole(i).sum_sq, every.whole(i).sum_sq);
            }
        }
    });
}

// Whoever looks at what is hit first has nothing traced that would not be without them.
TEST(Aovs, TraceNoRaysOfTheirOwn)
{
    const SceneDescription d = half_a_wall();
    RenderRequest r;
    const auto counted = [&](const std::vector<Aov>& which) {
        r.aovs = which;
        const Counters c = render(d, r).counters;
        return std::array{c.camera_rays, c.background_only_samples, c.bounce_rays, c.shadow_rays};
    };
    ASSERT_GT(counted({})[1], 0u) << "no square of open sky";
    EXPECT_EQ(counted({}), counted(all_aovs()));
    r.aovs = all_aovs();
    const Film film = render(d, r).film;
    for (size_t i = 0; i < film.pixels.size(); ++i)
        EXPECT_EQ(film.whole_aov(i, film.aov_layout.offset(AovSum::samples)), film.whole(i).n);
}

// The loop over eight paths at a time tells of the same surfaces as the loop for all.
TEST(Aovs, OfEightAtATimeAreThoseOfTheLoopForAll)
{
    uint32_t wide = 0;
    for (const NamedScene& scene : all_test_scenes()) {
        RenderRequest r;
        r.aovs = all_aovs();
        wide += Renderer(build_scene(scene.description), r.settings).profile() == Profile::wide;
        const auto chosen = planes_of(scene.description, r);
        r.settings.kernel.profile = Profile::all;
        EXPECT_TRUE(same(chosen, planes_of(scene.description, r))) << scene.name;
    }
    EXPECT_GE(wide, 3u);
}

}  // namespace
}  // namespace lancer
