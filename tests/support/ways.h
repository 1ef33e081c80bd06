// The three ways to find direct light, and the claim that they find the same: Welch's test in every tile of 8 x 8
// pixels and on whole pictures, Sidak over all of them. Says how small a bias would have shown.
#pragma once

#include <array>
#include <cstdio>

#include "support/shoot.h"

namespace lancer {

constexpr std::array<DirectLight, 3> ways{DirectLight{true, true}, DirectLight{true, false}, DirectLight{false, false}};
constexpr std::array<const char*, 3> way_names{"nee and mis", "nee", "bsdf"};

// Judged when it goes out of scope.
class SameByAllWays {
public:
    // detectable: what four sigma of the difference of two whole pictures may be at most, relative to their mean; or
    // the test could not tell.
    explicit SameByAllWays(double detectable) : detectable_(detectable) {}

    // pictures: of each way. A way that is noisier than the others gets `effort` times the samples of shot.
    void add(const std::string& name, const SceneDescription& d, Shot shot, Path path, uint32_t pictures,
             std::array<uint32_t, 3> effort = {1, 1, 1})
    {
        std::array<std::vector<stats::Tally>, 3> found;
        const uint32_t spp = shot.spp;
        for (size_t i = 0; i < ways.size(); ++i) {
            path.direct = ways[i];
            shot.integrator = path;
            shot.spp = spp * effort[i];
            shot.seed = i + 1;
            found[i] = tiles_over_seeds(d, shot, pictures);
        }
        double worst = 0;
        for (size_t a = 0; a < ways.size(); ++a)
            for (size_t b = a + 1; b < ways.size(); ++b) {
                const std::string what = name + ": " + way_names[a] + " against " + way_names[b];
                const size_t whole = found[a].size() - 1;
                for (size_t t = 0; t < whole; ++t) tiles_.add(stats::welch_p(found[a][t], found[b][t]), what);
                const stats::Tally &x = found[a][whole], &y = found[b][whole];
                wholes_.add(stats::welch_p(x, y), what);
                const double sigma = std::sqrt(x.error() * x.error() + y.error() * y.error());
                worst = std::max(worst, 4 * sigma / x.mean);
            }
        EXPECT_GT(found[0].back().mean, 0.05) << name << ": hardly lit";
        EXPECT_LT(worst, detectable_) << name << ": too noisy to tell";
        testing::Test::RecordProperty(name + ": smallest detectable bias", std::to_string(worst));
        std::printf("%s: biases above %.2g %% would show\n", name.c_str(), 100 * worst);
    }

private:
    double detectable_;
    stats::Family tiles_, wholes_;
};

}  // namespace lancer
