// The same pixels, to the last bit of the film's sums, however the work is cut up.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "support/render.h"

namespace lancer {
namespace {

// Whether two films agree bit for bit where both have pixels; says where they first do not.
testing::AssertionResult same(const Film& a, const Film& b)
{
    const Tile common{std::max(a.crop.x0, b.crop.x0), std::max(a.crop.y0, b.crop.y0), std::min(a.crop.x1, b.crop.x1),
                      std::min(a.crop.y1, b.crop.y1)};
    for (uint32_t y = common.y0; y < common.y1; ++y)
        for (uint32_t x = common.x0; x < common.x1; ++x) {
            const Pixel &p = a.at(x, y), &q = b.at(x, y);
            const auto bits = [](double v) { return std::bit_cast<uint64_t>(v); };
            if (p.n != q.n || bits(p.sum_sq) != bits(q.sum_sq) || bits(p.sum[0]) != bits(q.sum[0]) ||
                bits(p.sum[1]) != bits(q.sum[1]) || bits(p.sum[2]) != bits(q.sum[2]))
                return testing::AssertionFailure() << "pixel " << x << ", " << y << ": " << p.sum[0] << " of " << p.n
                                                   << " and " << q.sum[0] << " of " << q.n;
        }
    return testing::AssertionSuccess();
}

struct PixelCase {
    TestScene scene;
    AnyIntegrator integrator;

    std::string name() const
    {
        std::string name = std::visit([](const auto& i) { return std::string(name_of(i.kind)); }, integrator);
        std::replace(name.begin(), name.end(), '-', '_');
        return std::string(scene.name) + "_" + name;
    }
    friend void PrintTo(const PixelCase& c, std::ostream* out) { *out << c.name(); }
};
std::vector<PixelCase> pixel_cases()
{
    std::vector<PixelCase> cases;
    for (const TestScene& s : test_scenes())
        for (const AnyIntegrator& integrator : all_integrators()) cases.push_back({s, integrator});
    return cases;
}

class SamePixels : public testing::TestWithParam<PixelCase> {
protected:
    SceneDescription scene = GetParam().scene.make();
    RenderRequest request = [] {
        RenderRequest r;
        r.settings.integrator = GetParam().integrator;
        return r;
    }();

    // The picture of the plain request is no black nor flat one, or nothing would be compared.
    Film reference()
    {
        Film f = render(scene, request).film;
        double least = INFINITY, most = 0;
        for (const Pixel& p : f.pixels) least = std::min(least, p.sum[1]), most = std::max(most, p.sum[1]);
        EXPECT_GT(most, 2 * least + 1e-3);
        return f;
    }
};
INSTANTIATE_TEST_SUITE_P(Every, SamePixels, testing::ValuesIn(pixel_cases()),
                         [](const testing::TestParamInfo<PixelCase>& c) { return c.param.name(); });

TEST_P(SamePixels, OnAnyNumberOfThreads)
{
    const Film one = reference();
    for (const unsigned threads : {2u, 5u}) {
        RenderRequest r = request;
        r.threads = threads;
        EXPECT_TRUE(same(one, render(scene, r).film)) << threads;
    }
}

TEST_P(SamePixels, InTilesOfAnySize)
{
    const Film usual = reference();
    for (const uint32_t size : {8u, 37u}) {
        RenderRequest r = request;
        r.tile = size;
        EXPECT_TRUE(same(usual, render(scene, r).film)) << size;
    }
}

TEST_P(SamePixels, InBatchesOfAnySize)
{
    const Film usual = reference();
    for (const uint32_t batch : {1u, 8u, 100u}) {
        RenderRequest r = request;
        r.settings.kernel.batch = batch;
        EXPECT_TRUE(same(usual, render(scene, r).film)) << batch;
    }
}

TEST_P(SamePixels, InACrop)
{
    RenderRequest r = request;
    r.crop = {5, 3, 22, 17};
    const Film crop = render(scene, r).film;
    ASSERT_EQ(crop.pixels.size(), 17u * 14u);
    EXPECT_TRUE(same(reference(), crop));
}

TEST_P(SamePixels, InAnySplitOfTheSamples)
{
    RenderRequest r = request;
    r.width = 16, r.height = 12;
    r.spp = {64};
    const Film once = render(scene, r).film;
    r.spp = {16, 48};
    EXPECT_TRUE(same(once, render(scene, r).film));
    r.spp = {16, 16, 16, 16};
    EXPECT_TRUE(same(once, render(scene, r).film));
}

TEST_P(SamePixels, WithAnyAccelerator)
{
    RenderRequest r = request;
    r.width = 16, r.height = 12;
    const Film embree = render(scene, r).film;
    r.settings.accel = AccelKind::list;
    EXPECT_TRUE(same(embree, render(scene, r).film));
}

// Scaled by a power of two, every number inside the renderer is the same one: there is no absolute epsilon.
TEST_P(SamePixels, OfASceneOfAnySize)
{
    const Film usual = reference();
    for (const int k : {-20, -3, 7, 20})
        EXPECT_TRUE(same(usual, render(scaled_by(scene, std::ldexp(1.0, k)), request).film)) << k;
}

// And that the seed, the sampler and the filter are not without effect.
TEST_P(SamePixels, ButNotWithOtherRandomNumbers)
{
    const Film usual = reference();
    RenderRequest r = request;
    r.settings.kernel.seed = 1;
    EXPECT_FALSE(same(usual, render(scene, r).film));
    r = request;
    r.settings.kernel.sampler = SamplerKind::independent;
    EXPECT_FALSE(same(usual, render(scene, r).film));
    r = request;
    r.settings.kernel.filter = Filter(FilterKind::box);
    EXPECT_FALSE(same(usual, render(scene, r).film));
}

}  // namespace
}  // namespace lancer
