// Studies of which the truth is known: errors that fall by a power law, with noise, on a machine of uneven speed.
#pragma once

#include <cmath>

#include "report/study/results.h"
#include "support/random.h"

namespace lancer {

struct SyntheticMethod {
    std::string name;
    double relmse_1 = 1;         // the expected relMSE of one sample per pixel
    double exponent = -1;        // of relMSE over samples; RMSE has half of it
    double plateau = 0;          // what bias, or the noise of the reference, adds to relMSE
    double seconds_per_spp = 1;  // of the undisturbed machine
    double noise = 0.1;          // standard deviation of the logarithm of an error
    uint32_t last_spp = 256;
};

inline double normal(Random& random)
{
    const double u = 1 - random.uniform(), v = random.uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

// One run; slowness: how much longer than planned everything took.
StudyRun synthetic_run(const SyntheticMethod& m, const std::string& scene, uint64_t seed, double slowness,
                       Random& random);

// Every method with the same seeds, interleaved; what disturbs the machine disturbs the methods of a seed alike. The
// first method is the baseline.
Study synthetic_study(const std::vector<SyntheticMethod>& methods, uint64_t truth_seed, size_t seeds = 8,
                      const std::string& scene = "box");

}  // namespace lancer
