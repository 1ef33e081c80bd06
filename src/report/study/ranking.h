// Ranks a method against the baseline of its study on a scene: at equal time and at equal error, never at equal
// samples, and only if the interval of the ratio excludes 1. Not ranked: other biases, failed runs, few seeds,
// different machines, errors within the noise of the reference.
#pragma once

#include <string>

#include "report/study/comparison.h"

namespace lancer {

// With fewer seeds not even the range from the least to the largest holds the median in 95 of 100 studies:
// 1 - 2 * 0.5^5 = 0.94, 1 - 2 * 0.5^6 = 0.97.
inline constexpr size_t fewest_seeds = 6;

// Efficiency 1 / (relMSE * time). It is constant over time for plain Monte Carlo, so it is given with its time.
struct Efficiency {
    double seconds =
        0;             // the longest time at which every run of this method and of the baseline was measured; NaN: none
    double value = 0;  // of the median; 1/s
    Interval interval;
    double baseline = 0;  // the baseline's efficiency at the same time
    Comparison gain;      // over the baseline: at equal time the ratio of the errors
};

// The reason why this method may not be ranked against the baseline on the scene; empty if it may.
std::string why_not_ranked(const Study& study, const StudyScene& scene, const StudyMethod& method);

// At equal time.
Efficiency efficiency_of(const Study& study, const StudyScene& scene, const StudyMethod& method);

// At equal error: the time of the baseline to this relMSE over that of the method, both measured, not extrapolated.
Comparison speed_up(const Study& study, const StudyScene& scene, const StudyMethod& method, double target);

// The least relMSE, of 1, 2 and 5 times powers of ten, that every run of both reaches and that is above the noise of
// their references. NaN: none.
double equal_error(const Study& study, const StudyScene& scene, const StudyMethod& method);

// FLIP at the longest time at which every run of both was measured.
struct FlipAtTime {
    double seconds, baseline, method;  // medians; NaN: not measured
    Comparison ratio;
};
FlipAtTime flip_at_equal_time(const Study& study, const StudyScene& scene, const StudyMethod& method);

// Both of a method, on each scene of the study and over all of them.
struct Overview {
    std::vector<double> errors;  // equal_error() of each scene
    std::vector<Comparison> times;
    std::vector<FlipAtTime> flips;
    Comparison mean_time, mean_flip;
};
Overview overview_of(const Study& study, const StudyMethod& method);

}  // namespace lancer
