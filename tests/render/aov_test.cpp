// Auxiliary outputs: the values of a scene that can be told by hand, and that nobody but the asker notices them.
#include "render/aov.h"

#include <gtest/gtest.h>

#include <bit>
#include <numeric>

#include "support/render.h"

namespace lancer {
namespace {

std::vector<Aov> all_aovs()
{
    std::vector<Aov> all;
    for (size_t i = 0; i < aov_names.size(); ++i) all.push_back(static_cast<Aov>(i));
    return all;
}

// All channels of a render, by name; those of the light among them.
std::vector<ImagePlane> planes_of(const SceneDescription& d, const RenderRequest& r)
{
    const Film film = render(d, r).film;
    const Normalisation n = build_scene(d).normalisation;
    std::vector<ImagePlane> planes;
    if (!film.aovs.empty()) planes = aov_planes(film, all_aovs(), n);
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
    r.width = 9, r.height = 8, r.aovs = true;
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

TEST(Aovs, VarianceIsThatOfTheMean)
{
    Film film(1, 1, {0, 0, 1, 1});
    film.aovs.resize(1);
    const std::vector<float> samples{1, 2, 4, 5};
    for (const float v : samples) film.pixels[0] += {{v, v, v}, double{v} * v, 1};
    // Sample variance 10 / 3, by n.
    EXPECT_NEAR(aov_planes(film, {Aov::variance}, {})[0].values[0], 10.0 / 3 / 4, 1e-6);
}

class AovsSamePixels : public testing::TestWithParam<size_t> {
protected:
    SceneDescription scene = all_test_scenes()[GetParam()].description;
    RenderRequest request = [] {
        RenderRequest r;
        r.width = 12, r.height = 9;
        r.spp = {32};
        r.tile = 5;
        r.aovs = true;
        return r;
    }();
};
INSTANTIATE_TEST_SUITE_P(Every, AovsSamePixels, testing::Range(size_t{0}, all_test_scenes().size()));

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
    request.aovs = false;
    const Film without = render(scene, request).film;
    ASSERT_FALSE(with.aovs.empty());
    ASSERT_TRUE(without.aovs.empty());
    for (size_t i = 0; i < with.pixels.size(); ++i) {
        EXPECT_EQ(with.aovs[i].samples, 32u);
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
    for (const AnyIntegrator& integrator : all_integrators()) {
        request.settings.integrator = integrator;
        EXPECT_TRUE(same(first, without_light())) << std::visit([](const auto& i) { return i.name; }, integrator);
    }
}

TEST(Aovs, ACropHasTheValuesOfTheWhole)
{
    RenderRequest r;
    r.aovs = true;
    const SceneDescription scene = all_test_scenes()[0].description;
    const Film whole = render(scene, r).film;
    r.crop = {5, 3, 22, 17};
    const Film crop = render(scene, r).film;
    for (uint32_t y = 3; y < 17; ++y)
        for (uint32_t x = 5; x < 22; ++x) {
            const AovPixel &a = whole.aovs[whole.index(x, y)], &b = crop.aovs[crop.index(x, y)];
            EXPECT_EQ(a.depth, b.depth);
            EXPECT_EQ(a.normal, b.normal);
            EXPECT_EQ(a.material, b.material);
        }
}

}  // namespace
}  // namespace lancer
