// The three ways to find direct light, and the claim that they find the same. Says how small a bias would have shown.
#pragma once

#include <array>

#include "support/shoot.h"

namespace lancer {

constexpr std::array<DirectLight, 3> ways{DirectLight{true, true}, DirectLight{true, false}, DirectLight{false, false}};
constexpr std::array<const char*, 3> way_names{"nee and mis", "nee", "bsdf"};

class SameByAllWays {
public:
    // detectable: see OneMean.
    explicit SameByAllWays(double detectable) : detectable_(detectable) {}

    // pictures: of each way, or as many more as it takes to tell. A way that is noisier than the others gets `effort`
    // times the samples of shot.
    void add(const std::string& name, const SceneDescription& d, Shot shot, Path path, uint32_t pictures,
             std::array<uint32_t, 3> effort = {1, 1, 1}) const
    {
        std::vector<TilesOverSeeds> found;
        const uint32_t spp = shot.spp;
        for (size_t i = 0; i < ways.size(); ++i) {
            path.direct = ways[i];
            shot.integrator = path;
            shot.spp = spp * effort[i];
            shot.seed = i + 1;
            found.emplace_back(d, shot);
        }
        const double mean = expect_one_mean(
            std::move(found),
            {.pictures = pictures, .detectable = detectable_, .names = {way_names.begin(), way_names.end()}}, name);
        EXPECT_GT(mean, 0.05) << name << ": hardly lit";
    }

private:
    double detectable_;
};

}  // namespace lancer
