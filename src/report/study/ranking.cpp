#include "report/study/ranking.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "report/study/curve.h"
#include "report/study/statistics.h"

namespace lancer {
namespace {

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

// The longest time at which every run of both was measured; NaN: none.
double common_time(const std::vector<CurvePair>& pairs)
{
    double first = 0, last = std::numeric_limits<double>::infinity();
    for (const CurvePair& p : pairs) {
        first = std::max({first, p.baseline.x.front(), p.method.x.front()});
        last = std::min({last, p.baseline.x.back(), p.method.x.back()});
    }
    return pairs.empty() || first > last ? no_number : last;
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
        if (const size_t failed = failed_runs(study, scene.name, name)) {
            const std::string why = std::to_string(failed) + (failed == 1 ? " run failed" : " runs failed");
            return name == method.name ? why : of_baseline(why);
        }
    const size_t seeds = pairs_of(study, scene, method).size();
    if (seeds >= fewest_seeds) return "";
    return "only " + std::to_string(seeds) + (seeds == 1 ? " seed" : " seeds") + " in common, of " +
           std::to_string(fewest_seeds) + " that an interval of 95 % wants";
}

Efficiency efficiency_of(const Study& study, const StudyScene& scene, const StudyMethod& method)
{
    Efficiency e{no_number, no_number, {no_number, no_number}, no_number, {}};
    e.gain.reason = why_not_ranked(study, scene, method);
    const std::vector<CurvePair> pairs = pairs_of(study, scene, method);
    if (pairs.empty()) {
        e.gain.reason = first_of({e.gain.reason, "no run"});
        return e;
    }
    const double last = common_time(pairs);
    if (std::isnan(last)) {
        e.gain.reason = first_of({e.gain.reason, "no time at which both were measured"});
        return e;
    }
    e.seconds = last;
    const auto log_error = [&](const ErrorCurve& curve) { return std::log(error_at(curve, last)); };
    std::vector<double> errors, baseline_errors;
    for (const CurvePair& p : pairs) {
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
    compare_pairs(pairs, log_error, e.gain);
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
    const std::vector<CurvePair> pairs = pairs_of(study, scene, method);
    if (!why.empty() || pairs.empty()) return result;
    compare_pairs(
        pairs, [&](const ErrorCurve& curve) { return log_reached(curve, target); }, result);
    if (method.name == study.baseline) result.rank = Rank::baseline;
    return result;
}

double equal_error(const Study& study, const StudyScene& scene, const StudyMethod& method)
{
    const std::vector<CurvePair> pairs = pairs_of(study, scene, method);
    double most = 0;
    for (const CurvePair& p : pairs)
        for (const ErrorCurve* curve : {&p.baseline, &p.method}) most = std::max(most, curve->y.back());
    for (const StudyMethod* m : {&method, find_method(study, study.baseline)})
        // Just above, as nothing is ranked at the limit itself.
        if (m) most = std::max(most, 1.0001 * noise_limit(reference_noise(study, scene, *m)));
    if (pairs.empty() || !std::isfinite(most) || most <= 0) return no_number;
    const double power = std::pow(10, std::floor(std::log10(most)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= most) return factor * power;
    return 10 * power;
}

FlipAtTime flip_at_equal_time(const Study& study, const StudyScene& scene, const StudyMethod& method)
{
    FlipAtTime flip{common_time(pairs_of(study, scene, method)), no_number, no_number, {}};
    flip.ratio.reason = why_not_ranked(study, scene, method);
    const StudyMethod* baseline = find_method(study, study.baseline);
    if (!baseline || std::isnan(flip.seconds)) {
        flip.ratio.reason = first_of({flip.ratio.reason, "no time at which both were measured"});
        return flip;
    }
    flip.baseline = errors_at(study, scene, *baseline, flip.seconds).flip;
    flip.method = errors_at(study, scene, method, flip.seconds).flip;
    if (!(flip.baseline > 0 && flip.method > 0)) {
        flip.ratio.reason = first_of({flip.ratio.reason, "FLIP was not measured"});
        return flip;
    }
    compare_pairs(
        pairs_of(study, scene, method, &ErrorPoint::flip),
        [&](const ErrorCurve& curve) { return std::log(error_at(curve, flip.seconds)); }, flip.ratio);
    if (method.name == study.baseline) flip.ratio.rank = Rank::baseline;
    return flip;
}

Overview overview_of(const Study& study, const StudyMethod& method)
{
    Overview all;
    std::vector<Comparison> flips;
    for (const StudyScene& scene : study.scenes) {
        all.errors.push_back(equal_error(study, scene, method));
        all.times.push_back(speed_up(study, scene, method, all.errors.back()));
        all.flips.push_back(flip_at_equal_time(study, scene, method));
        flips.push_back(all.flips.back().ratio);
    }
    all.mean_time = geometric_mean_of(all.times);
    all.mean_flip = geometric_mean_of(flips);
    return all;
}

}  // namespace lancer
