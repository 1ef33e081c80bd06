// Pictures for the tests of integrators: one call with what these vary, and the means and errors they judge.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <limits>
#include <span>

#include "support/render.h"
#include "support/salt.h"
#include "support/statistics/significance.h"

namespace lancer {

struct Shot {
    AnyIntegrator integrator = Path{};
    uint32_t width = 32, height = 32, spp = 16;
    SamplerKind sampler = SamplerKind::sobol;
    AccelKind accel = AccelKind::embree;
    uint64_t seed = 0;
    RasterSource images = test_picture;
};

// What a render is asked for, on one thread. S: a Shot, or another struct with its fields.
template <class S>
RenderRequest request_of(const S& shot)
{
    RenderRequest r;
    r.width = shot.width, r.height = shot.height, r.spp = {shot.spp};
    r.settings.integrator = shot.integrator;
    r.settings.accel = shot.accel;
    r.settings.kernel.sampler = shot.sampler;
    r.settings.kernel.seed = salted(shot.seed);
    r.settings.kernel.filter = Filter(FilterKind::box);
    return r;
}

Film shoot(const SceneDescription& d, const Shot& shot);

// Roulette never ends a path.
inline constexpr uint32_t no_roulette = 1000000;
Path without_roulette(Path path = {});

// Luminance of one pixel's samples; they must be independent for the error to hold.
stats::Tally tally(const Pixel& p);
stats::Tally tally(const Film& film);

void expect_all_equal(const Film& film, Color expected, float relative, const std::string& what);

bool same_bits(const Film& a, const Film& b);

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

double detectable_bias(std::span<const TilesOverSeeds> ways);

// Adds pictures until the bias that is wanted would show, at most eight times those of the claim. What decides is how
// far the pictures of one way lie apart, never how far the ways do, so that the tests of their means stay true: Stein,
// "A Two-Sample Test for a Linear Hypothesis Whose Power is Independent of the Variance", 1945.
double add_until_detectable(std::span<TilesOverSeeds> ways, const OneMean& claim);

// The two ways and the tile that are the least alike, among the tiles or among the wholes.
struct Suspect {
    double p = 1;
    size_t tests = 0, a = 0, b = 0, tile = 0;

    bool is_red() const { return p < sidak(0.01, std::max<size_t>(1, tests)); }
};
std::array<Suspect, 2> suspects_among(std::span<const TilesOverSeeds> ways, double rounding);

// Few pictures tell little for certain: of a hundred claims that hold, one or two look wrong. What looks wrong is
// therefore looked at again, there alone, in twice as many other pictures, and must be as unlikely as 1 in 1000: both
// happen by chance to one claim in 50,000 (claim_level), and a bias that shows once shows again. Returns the mean of
// the first way, and says what bias would have shown.
double expect_one_mean(std::vector<TilesOverSeeds> ways, const OneMean& claim, const std::string& name);

}  // namespace lancer
