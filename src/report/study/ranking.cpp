#include "report/study/ranking.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "report/study/curve.h"
#include "report/study/statistics.h"

namespace lancer {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
using CurveFigure = std::function<double(const ErrorCurve&)>;

struct Pair {
    ErrorCurve baseline, method;
};

// The runs of both with the same seed.
std::vector<Pair> pairs_of(const Study& study, const StudyScene& scene, const StudyMethod& method)
{
    std::vector<Pair> pairs;
    const auto others = runs_of(study, scene.name, study.baseline);
    for (const StudyRun* run : runs_of(study, scene.name, method.name)) {
        const auto other =
            std::find_if(others.begin(), others.end(), [&](const StudyRun* o) { return o->seed == run->seed; });
        if (other != others.end())
            pairs.push_back({curve_of(**other, Along::time, &ErrorPoint::relmse),
                             curve_of(*run, Along::time, &ErrorPoint::relmse)});
    }
    return pairs;
}

// Finite, so that differences are numbers: beyond either end of what was measured stands for very far.
double bounded(double logarithm) { return std::clamp(logarithm, -800.0, 800.0); }

// exp() of the difference of the medians of such logarithms.
void compare_medians(const std::vector<Pair>& pairs, const CurveFigure& logarithm_of, Comparison& result)
{
    std::vector<double> baseline, method;
    for (const Pair& p : pairs) {
        baseline.push_back(bounded(logarithm_of(p.baseline)));
        method.push_back(bounded(logarithm_of(p.method)));
    }
    const auto difference = [&](std::span<const size_t> drawn) {
        std::vector<double> a, b;
        for (const size_t i : drawn) a.push_back(baseline[i]), b.push_back(method[i]);
        return median(std::move(a)) - median(std::move(b));
    };
    result.ratio = std::exp(median(baseline) - median(method));
    const Interval interval = resampled_interval(pairs.size(), 0, difference);
    result.interval = {std::exp(interval.low), std::exp(interval.high)};
    if (!result.reason.empty()) return;
    result.rank = result.interval.low > 1    ? Rank::faster
                  : result.interval.high < 1 ? Rank::slower
                                             : Rank::no_difference;
}

const StudyMethod* find_method(const Study& study, const std::string& name)
{
    const auto found =
        std::find_if(study.methods.begin(), study.methods.end(), [&](const auto& m) { return m.name == name; });
    return found == study.methods.end() ? nullptr : &*found;
}

std::string why_other_biases(const StudyMethod& method, const StudyMethod& baseline)
{
    if (method.biased() != baseline.biased())
        return method.biased() ? "biased, the baseline is not" : "unbiased, the baseline is not";
    const std::set<std::string> a(method.biases.begin(), method.biases.end());
    return a == std::set<std::string>(baseline.biases.begin(), baseline.biases.end()) ? "" : "biased in another way";
}

// The first of these reasons that there is.
std::string first_of(std::initializer_list<std::string> reasons)
{
    const auto found = std::find_if(reasons.begin(), reasons.end(), [](const auto& r) { return !r.empty(); });
    return found == reasons.end() ? "" : *found;
}

std::string of_baseline(const std::string& reason) { return reason.empty() ? "" : "the baseline: " + reason; }

}  // namespace

std::string why_not_ranked(const Study& study, const StudyScene& scene, const StudyMethod& method)
{
    const StudyMethod* baseline = find_method(study, study.baseline);
    if (!baseline) return "no baseline";
    if (!study.not_comparable.empty()) return "not comparable";
    for (const std::string& name : {method.name, study.baseline}) {
        const MethodOnScene& known = study.on_scene(scene.name, name);
        const std::string why = first_of({known.left_out.empty() ? "" : "left out", known.not_ranked});
        if (!why.empty()) return name == method.name ? why : of_baseline(why);
    }
    if (const std::string biases = why_other_biases(method, *baseline); !biases.empty()) return biases;
    for (const std::string& name : {method.name, study.baseline})
        if (const size_t failed = failed_runs(study, scene.name, name))
            return (name == method.name ? "" : "the baseline: ") + std::to_string(failed) +
                   (failed == 1 ? " run failed" : " runs failed");
    const size_t seeds = pairs_of(study, scene, method).size();
    if (seeds >= fewest_seeds) return "";
    return "only " + std::to_string(seeds) + (seeds == 1 ? " seed" : " seeds") + " in common, of " +
           std::to_string(fewest_seeds) + " that an interval of 95 % wants";
}

Efficiency efficiency_of(const Study& study, const StudyScene& scene, const StudyMethod& method)
{
    Efficiency e{no_number, no_number, {no_number, no_number}, no_number, {}};
    e.gain.reason = why_not_ranked(study, scene, method);
    const std::vector<Pair> pairs = pairs_of(study, scene, method);
    if (pairs.empty()) {
        e.gain.reason = first_of({e.gain.reason, "no run"});
        return e;
    }
    double first = 0, last = std::numeric_limits<double>::infinity();
    for (const Pair& p : pairs) {
        first = std::max({first, p.baseline.x.front(), p.method.x.front()});
        last = std::min({last, p.baseline.x.back(), p.method.x.back()});
    }
    if (first > last) {
        e.gain.reason = first_of({e.gain.reason, "no time at which both were measured"});
        return e;
    }
    e.seconds = last;
    const auto log_error = [&](const ErrorCurve& curve) { return std::log(error_at(curve, last)); };
    std::vector<double> errors, baseline_errors;
    for (const Pair& p : pairs) {
        errors.push_back(bounded(log_error(p.method)));
        baseline_errors.push_back(bounded(log_error(p.baseline)));
    }
    const auto limit = [&](const StudyMethod& m) { return noise_limit(reference_noise(study, scene, m)); };
    const StudyMethod* other = find_method(study, study.baseline);
    const bool below = std::exp(median(errors)) <= limit(method);
    const bool baseline_below = other && std::exp(median(baseline_errors)) <= limit(*other);
    if (!below) {
        e.value = std::exp(-median(errors)) / last;
        const Interval i = median_interval(errors);
        e.interval = {std::exp(-i.high) / last, std::exp(-i.low) / last};
    }
    if (!baseline_below) e.baseline = std::exp(-median(baseline_errors)) / last;
    if (below || baseline_below) {
        const std::string noise = why_no_time(Reach::below_noise);
        e.gain.reason = first_of({e.gain.reason, below ? noise : of_baseline(noise)});
        return e;
    }
    compare_medians(pairs, log_error, e.gain);
    if (method.name == study.baseline) e.gain.rank = Rank::baseline;
    return e;
}

Comparison speed_up(const Study& study, const StudyScene& scene, const StudyMethod& method, double target)
{
    Comparison result;
    result.reason = why_not_ranked(study, scene, method);
    const auto why_none = [&](const StudyMethod& m) {
        return why_no_time(time_to_error(study, scene, m, target).reach);
    };
    const StudyMethod* baseline = find_method(study, study.baseline);
    const std::string why = first_of({why_none(method), baseline ? of_baseline(why_none(*baseline)) : ""});
    result.reason = first_of({result.reason, why});
    const std::vector<Pair> pairs = pairs_of(study, scene, method);
    if (!why.empty() || pairs.empty()) return result;
    compare_medians(
        pairs, [&](const ErrorCurve& curve) { return log_reached(curve, target); }, result);
    if (method.name == study.baseline) result.rank = Rank::baseline;
    return result;
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
