// Pictures for rows: rendered with a given accelerator, counted into the row's outcome, compared by bits and by Welch's
// test. Rows about pictures try every accelerator by themselves: Embree's fast mode cannot render.
#pragma once

#include <array>

#include "stability/counted_render.h"
#include "support/salt.h"
#include "support/statistics/significance.h"

namespace lancer::stability {

// Those that the product promises something for; automatic is what a user gets who names none.
inline constexpr std::array judged_kinds{AccelKind::automatic, AccelKind::embree, AccelKind::bvh2, AccelKind::bvh8};
inline constexpr std::array judged_names{"embree", "bvh2", "bvh8"};

// The default plans nothing: small pictures would spend most of their time on the pilot.
struct CountedShot {
    uint32_t width = 24, height = 24, spp = 8;
    AnyIntegrator integrator = Path{.split = false, .roulette_by_pixel = false};
    AccelKind accel = AccelKind::automatic;
    SamplerKind sampler = SamplerKind::sobol;
    uint64_t seed = 0;
    unsigned threads = 1;
    std::string isa = "avx2";
};

Film take(const SceneDescription& d, const CountedShot& shot, Outcome& out);

inline double luminance_of(const Pixel& p) { return static_cast<double>(luminance(p.mean())); }
double mean_luminance(const Film& film);

// Root of the mean squared difference over the mean of `a`.
double relative_rmse(const Film& a, const Film& b);

// Means of 8 x 8 pixels, and of the whole as the last, over pictures with seeds of their own: shot.seed says which. By
// independent samples: what Sobol's points leave of the noise is too far from normal for tests of a few pictures.
std::vector<stats::Tally> tiles_over_seeds(const SceneDescription& d, CountedShot shot, uint32_t pictures,
                                           Outcome& out);

// The least p-value of a family of tests, held to Sidak's level of it.
struct LeastP {
    double p = 1;
    size_t tests = 0;

    void add(double of_one) { p = of_one <= p ? of_one : std::isnan(of_one) ? 0 : p, ++tests; }
    // Every tile and the whole. rounding: what the sums may differ by though they are of the same samples.
    void add(const std::vector<stats::Tally>& a, const std::vector<stats::Tally>& b)
    {
        for (size_t i = 0; i < a.size(); ++i) add(stats::welch_p(a[i], b[i], 1e-6));
    }
    // Ten rows ask it: with other random numbers one of them is red by chance in one of a hundred runs.
    double threshold() const { return sidak(0.001, std::max<size_t>(1, tests)); }
    Measure measure(const std::string& what) const { return at_least(what, p, threshold()); }
};
// What four sigma of the difference of two whole pictures are, relative to the mean: a smaller bias would not show.
inline Measure detectable(const std::vector<stats::Tally>& a, const std::vector<stats::Tally>& b)
{
    return told("bias of the whole that would show, relative",
                4 * std::hypot(a.back().error(), b.back().error()) / a.back().mean);
}

}  // namespace lancer::stability
