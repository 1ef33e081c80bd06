// Pictures for the tests of integrators: one call with what these vary, and the means and errors they judge.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>

#include "support/render.h"
#include "support/significance.h"

namespace lancer {

struct Shot {
    AnyIntegrator integrator = Path{};
    uint32_t width = 32, height = 32, spp = 16;
    SamplerKind sampler = SamplerKind::sobol;
    AccelKind accel = AccelKind::embree;
    uint64_t seed = 0;
    RasterSource images = test_picture;
};

inline Film shoot(const SceneDescription& d, const Shot& shot)
{
    RenderRequest r;
    r.width = shot.width, r.height = shot.height, r.spp = {shot.spp}, r.threads = 2;
    r.images = shot.images;
    r.settings.integrator = shot.integrator;
    r.settings.accel = shot.accel;
    r.settings.kernel.sampler = shot.sampler;
    r.settings.kernel.seed = shot.seed;
    r.settings.kernel.filter = Filter(FilterKind::box);
    Rendered out = render(d, r);
    EXPECT_EQ(out.counters.dropped, 0u) << "samples that are no numbers";
    return std::move(out.film);
}

// Roulette never ends a path.
inline constexpr uint32_t no_roulette = 1000000;
inline Path without_roulette(Path path = {})
{
    path.roulette_depth = no_roulette;
    path.roulette_by_pixel = false;
    return path;
}

// Luminance of one pixel's samples; they must be independent for the error to hold.
inline stats::Tally tally(const Pixel& p)
{
    stats::Tally t;
    t.n = p.n;
    t.mean = (0.2126 * p.sum[0] + 0.7152 * p.sum[1] + 0.0722 * p.sum[2]) / p.n;
    t.m2 = std::max(0.0, p.sum_sq - t.n * t.mean * t.mean);
    return t;
}
inline stats::Tally tally(const Film& film)
{
    Pixel all;
    for (const Pixel& p : film.pixels) all += p;
    return tally(all);
}

inline void expect_all_equal(const Film& film, Color expected, float relative, const std::string& what)
{
    for (const Pixel& p : film.pixels) {
        const Color c = p.mean();
        ASSERT_NEAR(c.r, expected.r, relative * expected.r) << what;
        ASSERT_NEAR(c.g, expected.g, relative * expected.g) << what;
        ASSERT_NEAR(c.b, expected.b, relative * expected.b) << what;
    }
}

inline bool same_bits(const Film& a, const Film& b)
{
    for (size_t i = 0; i < a.pixels.size(); ++i)
        if (a.pixels[i].sum != b.pixels[i].sum || a.pixels[i].n != b.pixels[i].n) return false;
    return a.pixels.size() == b.pixels.size();
}

// Means of 8 x 8 pixels, and of the whole as the last, over pictures with seeds of their own: what is compared has a
// known error whatever the points of one picture have to do with each other.
inline std::vector<stats::Tally> tiles_over_seeds(const SceneDescription& d, Shot shot, uint32_t pictures)
{
    const size_t count = size_t{shot.width / 8} * (shot.height / 8);
    std::vector<stats::Tally> tiles(count + 1);
    for (uint32_t k = 0; k < pictures; ++k) {
        shot.seed = shot.seed * 6364136223846793005u + 1442695040888963407u + k;
        const Film film = shoot(d, shot);
        std::vector<double> sum(count + 1);
        for (uint32_t y = 0; y < shot.height; ++y)
            for (uint32_t x = 0; x < shot.width; ++x)
                sum[size_t{y / 8} * (shot.width / 8) + x / 8] += tally(film.at(x, y)).mean / 64;
        for (size_t i = 0; i < count; ++i) sum[count] += sum[i] / static_cast<double>(count);
        for (size_t i = 0; i <= count; ++i) tiles[i].add(sum[i]);
    }
    return tiles;
}

// Lets `name` claim that all ways have one mean, in every tile and as a whole; says what bias would have shown.
inline void expect_one_mean(const std::vector<std::vector<stats::Tally>>& ways, double detectable,
                            const std::string& name)
{
    stats::Family tiles, wholes;
    double worst = 0;
    for (size_t a = 0; a < ways.size(); ++a)
        for (size_t b = a + 1; b < ways.size(); ++b) {
            const size_t whole = ways[a].size() - 1;
            // What is the same sum in another order differs by roundings.
            for (size_t t = 0; t < whole; ++t)
                tiles.add(stats::welch_p(ways[a][t], ways[b][t], 1e-5), name + ", tile " + std::to_string(t));
            const stats::Tally &x = ways[a][whole], &y = ways[b][whole];
            wholes.add(stats::welch_p(x, y, 1e-5), name);
            worst = std::max(worst, 4 * std::hypot(x.error(), y.error()) / x.mean);
        }
    EXPECT_LT(worst, detectable) << name << ": too noisy to tell";
    std::printf("%s: biases above %.2g %% would show\n", name.c_str(), 100 * worst);
}

}  // namespace lancer
