// Passes may end after any sample, and replicates are renders of their own: neither moves a bit.
#include <gtest/gtest.h>

#include "support/render.h"
#include "support/scenes/scenes.h"

namespace lancer {
namespace {

// In passes of any sizes, blocks staying open between them.
Film render_in(const std::vector<uint32_t>& passes, const RenderRequest& r, bool keeps_open, uint32_t replicates = 1)
{
    const SceneDescription d = cornell_scene();
    RendererConfig settings = r.settings;
    settings.kernel.replicates = replicates;
    Film film(r.width, r.height, {0, 0, r.width, r.height});
    film.keep_aovs(layout_of(all_aovs()));
    if (keeps_open) film.keep_blocks_open();
    if (replicates > 1) film.replicates.resize(film.pixels.size() * replicates);
    with_threads(1, [&] {
        const Renderer renderer(build_scene(d, r.images), settings);
        const Camera camera = camera_of(d, renderer.scene(), r.width, r.height);
        const std::vector<Tile> tiles = make_tiles(film.crop, r.tile);
        uint32_t begin = 0;
        for (const uint32_t n : passes) {
            renderer.pass(camera, film, tiles, {begin, begin + n});
            begin += n;
        }
    });
    return film;
}

void expect_same(const Film& a, const Film& b)
{
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Pixel x = a.whole(i), y = b.whole(i);
        ASSERT_EQ(x.n, y.n) << i;
        ASSERT_EQ(x.sum, y.sum) << i;
        ASSERT_EQ(x.sum_sq, y.sum_sq) << i;
        for (size_t k = 0; k < a.aov_layout.size(); ++k) ASSERT_EQ(a.whole_aov(i, k), b.whole_aov(i, k)) << i;
    }
}

class EachIntegrator : public testing::TestWithParam<AnyIntegrator> {
protected:
    RenderRequest request() const
    {
        RenderRequest r;
        r.width = 12, r.height = 10;
        r.settings.integrator = GetParam();
        return r;
    }
};

TEST_P(EachIntegrator, PassesThatEndAnywhereHaveTheBitsOfOne)
{
    const Film whole = render_in({45}, request(), false);
    expect_same(render_in({1, 1, 2, 4, 3, 6, 10, 1, 4, 9, 4}, request(), true), whole);
    expect_same(render_in({5, 11, 16, 13}, request(), false), whole);  // the first block needs no more memory
}

TEST_P(EachIntegrator, TheFirstReplicateIsTheRenderWithout)
{
    constexpr uint32_t replicates = 4, each = 8;
    const Film plain = render_in({each}, request(), false);
    const Film dealt = render_in({7, replicates * each - 7}, request(), true, replicates);
    for (size_t i = 0; i < plain.pixels.size(); ++i) {
        uint32_t n = 0;
        std::array<double, 3> sum{};
        for (uint32_t r = 0; r < replicates; ++r) {
            const ReplicateSum& s = dealt.replicates[i * replicates + r];
            n += s.n;
            for (size_t c = 0; c < 3; ++c) sum[c] += s.sum[c];
        }
        ASSERT_EQ(n, dealt.whole(i).n);
        for (size_t c = 0; c < 3; ++c) ASSERT_DOUBLE_EQ(sum[c], dealt.whole(i).sum[c]) << i;
        // Where paths split their parts are dealt to the path's replicate, so that only the sums are of as many.
        ASSERT_EQ(dealt.replicates[i * replicates].n, plain.pixels[i].n);
        for (size_t c = 0; c < 3; ++c)
            ASSERT_DOUBLE_EQ(dealt.replicates[i * replicates].sum[c], plain.pixels[i].sum[c]) << i;
    }
}

TEST_P(EachIntegrator, ReplicatesDifferFromOneAnotherAndFromNeighbouringSeeds)
{
    const Film dealt = render_in({32}, request(), false, 4);
    RenderRequest next = request();
    next.settings.kernel.seed = 1;
    const Film other = render_in({8}, next, false);
    uint32_t same = 0, of_next_seed = 0;
    for (size_t i = 0; i < other.pixels.size(); ++i) {
        const ReplicateSum* r = &dealt.replicates[i * 4];
        // Black pixels are black with any numbers.
        if (r[0].sum[0] == 0) continue;
        same += r[0].sum == r[1].sum && r[1].sum == r[2].sum && r[2].sum == r[3].sum;
        of_next_seed += r[1].sum == other.pixels[i].sum;
    }
    EXPECT_LT(same, other.pixels.size() / 2);
    EXPECT_LT(of_next_seed, other.pixels.size() / 2);
}

std::string name_of(const testing::TestParamInfo<AnyIntegrator>& of)
{
    std::string name(enum_names<IntegratorKind>[of.index]);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(All, EachIntegrator, testing::ValuesIn(all_integrators()), name_of);

}  // namespace
}  // namespace lancer
