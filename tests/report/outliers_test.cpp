// Where error comes from, against all samples of small pictures.
#include "report/outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/render.h"

namespace lancer {
namespace {

struct Case {
    SceneDescription description;
    RenderRequest request;
    std::unique_ptr<Renderer> renderer;
    Camera camera;
    Film film;

    explicit Case(SceneDescription d, uint32_t max_depth = 0)
        : description(std::move(d)),
          request([&] {
              RenderRequest r;
              r.width = 20, r.height = 16;
              std::get<Path>(r.settings.integrator).max_depth = max_depth;
              return r;
          }()),
          renderer(std::make_unique<Renderer>(build_scene(description), request.settings)),
          camera(camera_of(description, renderer->scene(), request.width, request.height)),
          film(request.width, request.height, {0, 0, request.width, request.height})
    {
        renderer->pass(camera, film, make_tiles(film.crop, 16), {0, 16});
    }
    ErrorSources sources(size_t count) const
    {
        ErrorSources s;
        with_threads(2, [&] { s = find_error_sources(*renderer, camera, film, count); });
        return s;
    }
    // The share of every sample.
    std::vector<Outlier> all() const
    {
        const PathListener deaf{[](const PathState&, const Hit&) {}, [](const PathState&, const Surface&) {},
                                [](const PathState&, Color) {}, [](const Ray&, Color, bool) {}};
        std::vector<Outlier> samples;
        double total = 0;
        for (uint32_t y = 0; y < film.height; ++y)
            for (uint32_t x = 0; x < film.width; ++x) {
                std::array<double, 16> l;
                for (uint32_t i = 0; i < 16; ++i)
                    l[i] = double{luminance(renderer->replay(camera, film.width, film.height, {x, y, i}, deaf))};
                const double mean = std::accumulate(l.begin(), l.end(), 0.0) / 16;
                for (uint32_t i = 0; i < 16; ++i) {
                    const double share = (l[i] - mean) * (l[i] - mean) / (mean * mean + 0.01);
                    samples.push_back({{x, y, i}, l[i], mean, share, {}, {}});
                    total += share;
                }
            }
        for (Outlier& o : samples) o.share /= total;
        std::sort(samples.begin(), samples.end(), [](const Outlier& a, const Outlier& b) { return a.share > b.share; });
        return samples;
    }
};

double sum_of(const std::vector<ErrorShare>& shares)
{
    return std::accumulate(shares.begin(), shares.end(), 0.0,
                           [](double s, const ErrorShare& e) { return s + e.share; });
}
bool has(const std::vector<ErrorShare>& shares, std::string_view part)
{
    return std::any_of(shares.begin(), shares.end(),
                       [&](const ErrorShare& e) { return e.name.find(part) != std::string::npos && e.share != 0; });
}

TEST(Outliers, AreTheLargestOfAllSamples)
{
    for (const SceneDescription& d : {cornell_scene(), glossy_scene(), lights_scene(), textured_scene()}) {
        const Case c(d);
        const std::vector<Outlier> all = c.all();
        const ErrorSources found = c.sources(5);
        ASSERT_EQ(found.outliers.size(), 5u);
        constexpr double rounding = 1e-6;  // of luminance in float
        for (size_t i = 0; i < 5; ++i) {
            const Outlier& o = found.outliers[i];
            EXPECT_NEAR(o.share, all[i].share, rounding * o.share) << i;
            const auto same = std::find_if(all.begin(), all.end(), [&](const Outlier& a) { return a.id == o.id; });
            ASSERT_NE(same, all.end());
            EXPECT_NEAR(o.share, same->share, rounding * o.share) << i;
            EXPECT_EQ(o.luminance, same->luminance) << i;
        }
        EXPECT_GE(found.others_at_most * (1 + rounding), all[5].share);
        EXPECT_LE(found.others_at_most, found.outliers[4].share);
    }
}

TEST(Outliers, SharesSumToOne)
{
    for (const SceneDescription& d : {cornell_scene(), glossy_scene(), lights_scene(), media_scene(), shapes_scene()}) {
        const ErrorSources s = Case(d).sources(3);
        EXPECT_NEAR(sum_of(s.classes), 1, 1e-5);
        EXPECT_NEAR(sum_of(s.materials), 1, 1e-12);
    }
}

// A path that scatters once brings direct light only. In a closed room there is no sky.
TEST(Outliers, ClassesFollowThePath)
{
    EXPECT_FALSE(has(Case(cornell_scene(), 1).sources(1).classes, "indirect"));
    EXPECT_TRUE(has(Case(cornell_scene(), 1).sources(1).classes, "direct, lamps"));
    EXPECT_TRUE(has(Case(cornell_scene()).sources(1).classes, "indirect, lamps"));
    EXPECT_FALSE(has(Case(cornell_scene()).sources(1).classes, "sky"));
    SceneDescription open = textured_scene();
    EXPECT_TRUE(has(Case(open).sources(1).classes, "sky"));
}

TEST(Outliers, AreNoneWhereSamplesAgree)
{
    const ErrorSources s = Case(closed_furnace(0)).sources(4);
    EXPECT_TRUE(s.outliers.empty());
    EXPECT_TRUE(s.classes.empty());
}

}  // namespace
}  // namespace lancer
