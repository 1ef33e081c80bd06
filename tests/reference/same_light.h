// The claim that several ways to render a scene have one mean: Welch's test for each pair of them, on the whole picture
// and in tiles, and Kolmogorov and Smirnov's test of the p-values of all pixels, which shows biases that no pixel shows
// by itself. Jung, Hanika, Dachsbacher, "Detecting Bias in Monte Carlo Renderers using Welch's t-test", JCGT 9(2),
// 2020.
#pragma once

#include <cstdio>
#include <deque>

#include "reference/reference.h"
#include "support/shoot.h"
#include "support/statistics/kolmogorov.h"

namespace lancer {

struct Way {
    std::string name;
    uint32_t width = 0, height = 0;
    std::vector<stats::Tally> pixels;  // of luminance, samples independent of each other
};

inline Way way_of(const reference::Picture& p)
{
    Way way{"reference", p.width, p.height, {}};
    for (size_t i = 0; i < p.mean.size(); ++i) {
        const auto n = static_cast<double>(p.spp);
        way.pixels.push_back({n, reference::luminance(p.mean[i]), p.variance[i] * n * (n - 1)});
    }
    return way;
}
inline Way way_of(const std::string& name, const Film& film)
{
    Way way{name, film.width, film.height, {}};
    for (const Pixel& p : film.pixels) way.pixels.push_back(tally(p));
    return way;
}

// The mean of several pixels with as many samples each, with the error that follows from theirs.
struct Mean {
    double value = 0, variance = 0, freedom = 0;  // variance: of the mean

    Mean(const Way& way, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1)
    {
        x1 = std::min(x1, way.width), y1 = std::min(y1, way.height);
        const double n = static_cast<double>(x1 - x0) * (y1 - y0);
        double squares = 0;
        for (uint32_t y = y0; y < y1; ++y)
            for (uint32_t x = x0; x < x1; ++x) {
                const stats::Tally& t = way.pixels[size_t{y} * way.width + x];
                const double v = t.variance() / t.n;
                value += t.mean / n, variance += v / (n * n);
                squares += v * v / (n * n * n * n) / (t.n - 1);
            }
        freedom = squares > 0 ? variance * variance / squares : 1;
    }
};

inline constexpr double float_rounding = 2e-6;  // of what is computed in float, to its mean

inline double welch_p(const Mean& a, const Mean& b)
{
    const double d = std::abs(a.value - b.value), floor = float_rounding * std::max(a.value, b.value);
    if (d <= floor) return 1;
    const double v = a.variance + b.variance;
    if (v == 0) return 0;
    const double freedom = v * v / (a.variance * a.variance / a.freedom + b.variance * b.variance / b.freedom);
    return stats::student_p((d - floor) / std::sqrt(v), freedom);
}

// All pairs of one scene's pictures. Judged when it goes out of scope.
class SameLight {
public:
    // detectable: the bias of a whole picture that four sigma of the noisiest pair may hide, relative to the mean.
    SameLight(std::string scene, double detectable) : scene_(std::move(scene)), detectable_(detectable) {}
    void add(Way way) { ways_.push_back(std::move(way)); }
    ~SameLight()
    {
        double worst = 0;
        {
            stats::Family wholes(alpha), tiles(alpha), spread(alpha);
            for (size_t a = 0; a < ways_.size(); ++a)
                for (size_t b = a + 1; b < ways_.size(); ++b)
                    worst = std::max(worst, compare(ways_[a], ways_[b], wholes, tiles, spread));
        }
        EXPECT_LT(worst, detectable_) << scene_ << ": too noisy to tell";
        std::printf("%s: %zu ways, biases above %.2g %% would show\n", scene_.c_str(), ways_.size(), 100 * worst);
    }
    SameLight(const SameLight&) = delete;
    SameLight& operator=(const SameLight&) = delete;

private:
    // One in a hundred runs of all scenes, with three families each, is red by chance.
    static inline const double alpha = sidak(0.01, 3 * 30);

    double compare(const Way& a, const Way& b, stats::Family& wholes, stats::Family& tiles, stats::Family& spread) const
    {
        const std::string what = scene_ + ": " + a.name + " against " + b.name;
        const Mean whole_a(a, 0, 0, a.width, a.height), whole_b(b, 0, 0, b.width, b.height);
        wholes.add(welch_p(whole_a, whole_b),
                   what + ", " + std::to_string(whole_a.value) + " against " + std::to_string(whole_b.value));
        constexpr uint32_t side = 8;
        for (uint32_t y = 0; y < a.height; y += side)
            for (uint32_t x = 0; x < a.width; x += side)
                tiles.add(welch_p({a, x, y, x + side, y + side}, {b, x, y, x + side, y + side}),
                          what + ", tile at " + std::to_string(x) + ", " + std::to_string(y));
        // Pixels without noise are equal or not, and have no place among p-values.
        std::vector<double> p;
        for (uint32_t y = 0; y < a.height; ++y)
            for (uint32_t x = 0; x < a.width; ++x) {
                const Mean pa(a, x, y, x + 1, y + 1), pb(b, x, y, x + 1, y + 1);
                const double rounding = 10 * float_rounding * std::max(pa.value, pb.value);
                if (pa.variance + pb.variance > rounding * rounding) {
                    p.push_back(welch_p(pa, pb));
                } else {
                    EXPECT_NEAR(pa.value, pb.value, rounding) << what << ", pixel " << x << ", " << y;
                }
            }
        if (p.size() >= 20) spread.add(stats::kolmogorov_p(p), what + ", p-values of pixels");
        return 4 * std::sqrt(whole_a.variance + whole_b.variance) / std::max(whole_a.value, whole_b.value);
    }

    std::string scene_;
    double detectable_;
    std::vector<Way> ways_;
};

}  // namespace lancer
