#include "report/study/comparison.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/study/statistics.h"

namespace lancer {
namespace {

using Logarithms = std::vector<std::array<double, 2>>;

// Of the medians of these pairs, numbers beyond the last one counted from the first one again.
double difference_of_medians(const Logarithms& pairs, std::span<const size_t> drawn)
{
    std::vector<double> baseline, method;
    for (const size_t i : drawn) {
        baseline.push_back(pairs[i % pairs.size()][0]);
        method.push_back(pairs[i % pairs.size()][1]);
    }
    return median(std::move(baseline)) - median(std::move(method));
}

void rank(Comparison& c, const Interval& logarithms)
{
    c.interval = {std::exp(logarithms.low), std::exp(logarithms.high)};
    if (!c.reason.empty()) return;
    c.rank = c.interval.low > 1 ? Rank::faster : c.interval.high < 1 ? Rank::slower : Rank::no_difference;
}

}  // namespace

double bounded(double logarithm) { return std::clamp(logarithm, -800.0, 800.0); }

std::vector<CurvePair> pairs_of(const Study& study, const StudyScene& scene, const StudyMethod& method,
                                double ErrorPoint::*error)
{
    std::vector<CurvePair> pairs;
    const auto others = runs_of(study, scene.name, study.baseline);
    for (const StudyRun* run : runs_of(study, scene.name, method.name)) {
        const auto other =
            std::find_if(others.begin(), others.end(), [&](const StudyRun* o) { return o->seed == run->seed; });
        if (other != others.end())
            pairs.push_back({curve_of(**other, Along::time, error), curve_of(*run, Along::time, error)});
    }
    return pairs;
}

void compare_pairs(const std::vector<CurvePair>& pairs, const std::function<double(const ErrorCurve&)>& logarithm_of,
                   Comparison& result)
{
    for (const CurvePair& p : pairs)
        result.logarithms.push_back({bounded(logarithm_of(p.baseline)), bounded(logarithm_of(p.method))});
    const auto difference = [&](std::span<const size_t> drawn) {
        return difference_of_medians(result.logarithms, drawn);
    };
    std::vector<size_t> all(pairs.size());
    std::iota(all.begin(), all.end(), size_t{0});
    result.ratio = std::exp(difference(all));
    rank(result, resampled_interval(pairs.size(), 0, difference));
}

Comparison geometric_mean_of(const std::vector<Comparison>& scenes)
{
    Comparison mean;
    std::vector<const Comparison*> ranked;
    std::vector<double> ratios;
    size_t seeds = 0;
    for (const Comparison& c : scenes) {
        if (c.rank == Rank::not_ranked || c.rank == Rank::baseline) continue;
        ranked.push_back(&c);
        ratios.push_back(c.ratio);
        seeds = std::max(seeds, c.logarithms.size());
    }
    if (ranked.empty()) {
        mean.reason = "ranked on no scene";
        return mean;
    }
    mean.ratio = geometric_mean(ratios);
    const auto logarithm = [&](std::span<const size_t> drawn) {
        double sum = 0;
        for (const Comparison* c : ranked) sum += difference_of_medians(c->logarithms, drawn);
        return sum / static_cast<double>(ranked.size());
    };
    rank(mean, resampled_interval(seeds, 0, logarithm));
    return mean;
}

std::string rank_text(const Comparison& comparison)
{
    switch (comparison.rank) {
        case Rank::baseline:
            return "the baseline";
        case Rank::faster:
            return "faster";
        case Rank::slower:
            return "slower";
        case Rank::no_difference:
            return "no difference found";
        case Rank::not_ranked:
            return "not ranked: " + comparison.reason;
    }
    return "";
}

}  // namespace lancer
