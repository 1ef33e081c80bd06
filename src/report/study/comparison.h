// A method against the baseline of its study by a figure of each run, such as the time to an error: the ratio of the
// medians, with an interval over pairs of seeds, on one scene or over several. study/ranking.h says which may be
// ranked.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "report/metrics/statistics.h"
#include "report/study/curve.h"
#include "report/study/results.h"

namespace lancer {

enum class Rank { baseline, faster, slower, no_difference, not_ranked };

// The baseline's figure over that of the method: above 1 the method is better.
struct Comparison {
    Rank rank = Rank::not_ranked;
    std::string reason;        // why it is not ranked
    double ratio = no_number;  // NaN where there is none
    Interval interval;  // 95 %, by resampling the seeds that both have, in pairs: what disturbed the machine while a
                        // seed was drawn disturbed both. 0 and infinity: the range goes beyond what was measured.
    std::vector<std::array<double, 2>> logarithms;  // of the figures of baseline and method, for each of these seeds
};

// The runs of both with the same seed.
struct CurvePair {
    ErrorCurve baseline, method;
};
std::vector<CurvePair> pairs_of(const Study& study, const StudyScene& scene, const StudyMethod& method,
                                double ErrorPoint::*error = &ErrorPoint::relmse);

// Finite, so that differences are numbers: beyond either end of what was measured stands for very far.
double bounded(double logarithm);

// Fills in ratio and interval by the logarithm of a figure of each curve, which may be infinite. Without a reason not
// to, it ranks. pairs: not empty.
void compare_pairs(const std::vector<CurvePair>& pairs, const std::function<double(const ErrorCurve&)>& logarithm_of,
                   Comparison& result);

// The geometric mean of the ratios of those that are ranked, a scene each. For its interval seeds are resampled
// together on all scenes.
Comparison geometric_mean_of(const std::vector<Comparison>& scenes);

// "faster", "not ranked: reason"
std::string rank_text(const Comparison& comparison);

}  // namespace lancer
