// Pictures for the tests of integrators: one call with what these vary, and the means and errors they judge.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <limits>
#include <span>

#include "support/render.h"
#include "support/salt.h"
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
    r.settings.kernel.seed = salted(shot.seed);
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
class TilesOverSeeds {
public:
    // shot.seed: tells this sequence of pictures from others.
    TilesOverSeeds(const SceneDescription& d, const Shot& shot)
        : description_(d), shot_(shot), tiles_(size_t{shot.width / 8} * (shot.height / 8) + 1)
    {
    }
    void add(uint32_t pictures)
    {
        const size_t count = tiles_.size() - 1;
        for (uint32_t k = 0; k < pictures; ++k) {
            shot_.seed = shot_.seed * 6364136223846793005u + 1442695040888963407u + taken_++;
            const Film film = shoot(description_, shot_);
            std::vector<double> sum(count + 1);
            for (uint32_t y = 0; y < shot_.height; ++y)
                for (uint32_t x = 0; x < shot_.width; ++x)
                    sum[size_t{y / 8} * (shot_.width / 8) + x / 8] += tally(film.at(x, y)).mean / 64;
            for (size_t i = 0; i < count; ++i) sum[count] += sum[i] / static_cast<double>(count);
            for (size_t i = 0; i <= count; ++i) tiles_[i].add(sum[i]);
        }
    }
    // What was added is forgotten; what comes next are other pictures.
    void begin_again() { tiles_.assign(tiles_.size(), {}); }

    const std::vector<stats::Tally>& tallies() const { return tiles_; }
    const stats::Tally& whole() const { return tiles_.back(); }

private:
    SceneDescription description_;
    Shot shot_;
    std::vector<stats::Tally> tiles_;
    uint32_t taken_ = 0;
};

// The claim that several ways to make a picture have one mean, in every tile and as a whole.
struct OneMean {
    uint32_t pictures = 0;  // of each way, or as many more as it takes to tell
    // What four sigma of the difference of two whole pictures may be at most, relative to their mean: a smaller bias
    // would not show.
    double detectable = std::numeric_limits<double>::infinity();
    double rounding = 1e-6;            // by which means may differ though nothing is wrong, relative
    std::vector<std::string> names{};  // of the ways, for messages
};

inline double detectable_bias(std::span<const TilesOverSeeds> ways)
{
    double worst = 0;
    for (size_t a = 0; a < ways.size(); ++a)
        for (size_t b = a + 1; b < ways.size(); ++b)
            worst = std::max(worst,
                             4 * std::hypot(ways[a].whole().error(), ways[b].whole().error()) / ways[a].whole().mean);
    return worst;
}

// Adds pictures until the bias that is wanted would show, at most eight times those of the claim. What decides is how
// far the pictures of one way lie apart, never how far the ways do, so that the tests of their means stay true: Stein,
// "A Two-Sample Test for a Linear Hypothesis Whose Power is Independent of the Variance", 1945.
inline double add_until_detectable(std::span<TilesOverSeeds> ways, const OneMean& claim)
{
    double worst = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 8 && !(worst < claim.detectable); ++round) {
        for (TilesOverSeeds& way : ways) way.add(claim.pictures);
        worst = detectable_bias(ways);
    }
    return worst;
}

// The two ways and the tile that are the least alike, among the tiles or among the wholes.
struct Suspect {
    double p = 1;
    size_t tests = 0, a = 0, b = 0, tile = 0;

    bool is_red() const { return p < sidak(0.01, std::max<size_t>(1, tests)); }
};
inline std::array<Suspect, 2> suspects_among(std::span<const TilesOverSeeds> ways, double rounding)
{
    std::array<Suspect, 2> least;
    for (size_t a = 0; a < ways.size(); ++a)
        for (size_t b = a + 1; b < ways.size(); ++b) {
            const auto &x = ways[a].tallies(), &y = ways[b].tallies();
            for (size_t t = 0; t < x.size(); ++t) {
                Suspect& s = least[t + 1 == x.size()];
                const double p = stats::welch_p(x[t], y[t], rounding);
                s.tests++;
                if (!(p >= s.p)) s.p = p, s.a = a, s.b = b, s.tile = t;
            }
        }
    return least;
}

// Few pictures tell little for certain: of a hundred claims that hold, one or two look wrong. What looks wrong is
// therefore looked at again, there alone, in twice as many other pictures, and must be as unlikely as 1 in 1000: both
// happen by chance to one claim in 50,000 (claim_level), and a bias that shows once shows again. Returns the mean of
// the first way, and says what bias would have shown.
inline double expect_one_mean(std::vector<TilesOverSeeds> ways, const OneMean& claim, const std::string& name)
{
    const double worst = add_until_detectable(ways, claim), mean = ways.at(0).whole().mean;
    EXPECT_LT(worst, claim.detectable) << name << ": too noisy to tell";
    std::printf("%s: biases above %.2g %% would show\n", name.c_str(), 100 * worst);
    const auto name_of = [&](size_t way) {
        return way < claim.names.size() ? claim.names[way] : "way " + std::to_string(way + 1);
    };
    for (const Suspect& s : suspects_among(ways, claim.rounding)) {
        if (is_salted()) std::printf("p = %.3g: %s\n", -std::expm1(double(s.tests) * std::log1p(-s.p)), name.c_str());
        if (!s.is_red()) continue;
        std::array pair{ways[s.a], ways[s.b]};
        for (TilesOverSeeds& way : pair) {
            const auto taken = static_cast<uint32_t>(way.whole().n);
            way.begin_again();
            way.add(2 * taken);
        }
        const stats::Tally &a = pair[0].tallies()[s.tile], &b = pair[1].tallies()[s.tile];
        EXPECT_GT(stats::welch_p(a, b, claim.rounding), 0.001)
            << name << ": " << name_of(s.a) << " " << a.mean << ", " << name_of(s.b) << " " << b.mean
            << (s.tile + 1 == ways[s.a].tallies().size() ? ", as a whole" : ", in tile " + std::to_string(s.tile));
    }
    return mean;
}

}  // namespace lancer
