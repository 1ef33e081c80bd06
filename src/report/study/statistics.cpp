#include "report/study/statistics.h"

#include <algorithm>
#include <cmath>

#include "report/study/curve.h"

namespace lancer {
namespace {

using Runs = std::vector<const StudyRun*>;

std::vector<ErrorCurve> curves_of(const Runs& runs, Along along, double ErrorPoint::*error)
{
    std::vector<ErrorCurve> curves;
    for (const StudyRun* run : runs) curves.push_back(curve_of(*run, along, error));
    return curves;
}

std::vector<double> errors_of(const std::vector<ErrorCurve>& curves, double x)
{
    std::vector<double> errors;
    for (const ErrorCurve& curve : curves) errors.push_back(error_at(curve, x));
    return errors;
}

CurvePoint point_at(const std::vector<ErrorCurve>& curves, double x)
{
    const std::vector<double> errors = errors_of(curves, x);
    return {x, median(errors), median_interval(errors)};
}

std::vector<CurvePoint> curve_over_time(const std::vector<ErrorCurve>& curves, double first, double last)
{
    std::vector<CurvePoint> points;
    if (!(first <= last)) return points;
    points.push_back(point_at(curves, first));
    for (double k = std::floor(2 * std::log2(first)) + 1; std::exp2(0.5 * k) < last; ++k)
        if (std::exp2(0.5 * k) > first) points.push_back(point_at(curves, std::exp2(0.5 * k)));
    if (first < last) points.push_back(point_at(curves, last));
    return points;
}

// At the numbers of samples at which every run was measured.
std::vector<CurvePoint> curve_over_samples(const std::vector<ErrorCurve>& curves)
{
    std::vector<CurvePoint> points;
    if (curves.empty()) return points;
    for (const double spp : curves.front().x) {
        const bool in_all = std::all_of(curves.begin(), curves.end(), [&](const ErrorCurve& c) {
            return std::binary_search(c.x.begin(), c.x.end(), spp);
        });
        if (in_all) points.push_back(point_at(curves, spp));
    }
    return points;
}

std::optional<Slope> slope_of(const Runs& runs, Along along, double limit)
{
    std::vector<double> exponents;
    for (const StudyRun* run : runs) {
        const ErrorCurve last =
            last_points(curve_of(*run, along, &ErrorPoint::rmse), curve_of(*run, along, &ErrorPoint::relmse), limit);
        if (last.x.size() >= 3) exponents.push_back(fitted_exponent(last.x, last.y));
    }
    if (exponents.empty() || exponents.size() < runs.size()) return {};
    return Slope{median(exponents), median_interval(exponents)};
}

// Medians of logarithms of times, of which some are infinite.
double median_of_times(std::vector<double> times)
{
    const double found = median(std::move(times));
    return std::isnan(found) ? std::numeric_limits<double>::infinity() : found;
}

TimeToError time_to(const std::vector<ErrorCurve>& curves, double target, double limit, bool may_extrapolate)
{
    TimeToError time{target, Reach::not_measured, no_number, {no_number, no_number}};
    if (curves.empty() || std::any_of(curves.begin(), curves.end(), [](const auto& c) { return c.empty(); }))
        return time;
    time.reach = Reach::below_noise;
    if (target <= limit) return time;
    std::vector<double> logs;
    const auto middle_by = [&](double (*of)(const ErrorCurve&, double)) {
        logs.clear();
        for (const ErrorCurve& curve : curves) logs.push_back(of(curve, target));
        return median_of_times(logs);
    };
    double found = middle_by(log_reached);
    time.reach = Reach::measured;
    if (found > 0 && std::isinf(found) && may_extrapolate) {
        found = middle_by(log_extrapolated);
        time.reach = Reach::extrapolated;
    }
    if (std::isinf(found)) {
        time.reach = found > 0 ? Reach::not_reached : Reach::at_once;
        for (const ErrorCurve& curve : curves)
            if (found < 0) time.seconds = std::fmax(time.seconds, curve.x.front());
        return time;
    }
    time.seconds = std::exp(found);
    const Interval interval = resampled_interval(logs.size(), 0, [&](std::span<const size_t> drawn) {
        std::vector<double> chosen;
        for (const size_t i : drawn) chosen.push_back(logs[i]);
        return median_of_times(std::move(chosen));
    });
    time.interval = {std::exp(interval.low), std::exp(interval.high)};
    return time;
}

}  // namespace

std::string why_no_time(Reach reach)
{
    switch (reach) {
        case Reach::measured:
            return "";
        case Reach::extrapolated:
            return "reached only beyond the measurements";
        case Reach::at_once:
            return "reached before the first measurement";
        case Reach::not_reached:
            return "not reached";
        case Reach::below_noise:
            return "below the noise of the reference";
        case Reach::not_measured:
            return "no run";
    }
    return "";
}

double reference_noise(const Study& study, const StudyScene& scene, const StudyMethod& method)
{
    const MethodOnScene& own = study.on_scene(scene.name, method.name);
    return own.reference.empty() ? scene.reference_noise_relmse : own.reference_noise_relmse;
}

size_t failed_runs(const Study& study, const std::string& scene, const std::string& method)
{
    return static_cast<size_t>(std::count_if(study.runs.begin(), study.runs.end(), [&](const StudyRun& r) {
        return r.failed && r.scene == scene && r.method == method;
    }));
}

std::vector<const StudyRun*> runs_of(const Study& study, const std::string& scene, const std::string& method)
{
    Runs runs;
    for (const StudyRun& run : study.runs) {
        if (run.scene == scene && run.method == method && !run.failed &&
            !curve_of(run, Along::time, &ErrorPoint::relmse).empty())
            runs.push_back(&run);
    }
    std::sort(runs.begin(), runs.end(), [](const StudyRun* a, const StudyRun* b) { return a->seed < b->seed; });
    return runs;
}

TimeToError time_to_error(const Study& study, const StudyScene& scene, const StudyMethod& method, double target)
{
    const auto curves = curves_of(runs_of(study, scene.name, method.name), Along::time, &ErrorPoint::relmse);
    return time_to(curves, target, noise_limit(reference_noise(study, scene, method)), !method.biased());
}

MethodFigures figures_of(const Study& study, const StudyScene& scene, const StudyMethod& method)
{
    const Runs runs = runs_of(study, scene.name, method.name);
    MethodFigures figures{&method, runs.size(), 0, no_number, no_number, {}, {}, {}, {}, {}, {}};
    figures.failed = failed_runs(study, scene.name, method.name);
    const auto curves = curves_of(runs, Along::time, &ErrorPoint::relmse);
    for (const ErrorCurve& curve : curves) {
        figures.first_s = std::fmax(figures.first_s, curve.x.front());
        figures.last_s = std::fmin(figures.last_s, curve.x.back());
    }
    figures.time = curve_over_time(curves, figures.first_s, figures.last_s);
    figures.samples = curve_over_samples(curves_of(runs, Along::samples, &ErrorPoint::relmse));
    const double noise = reference_noise(study, scene, method);
    figures.slope_samples = slope_of(runs, Along::samples, slope_limit(noise));
    figures.slope_time = slope_of(runs, Along::time, slope_limit(noise));
    for (const double target : study_targets)
        figures.times.push_back(time_to(curves, target, noise_limit(noise), !method.biased()));
    // Noise of the reference adds to FLIP: a time is rather told as too long. It follows no power law.
    figures.flip_time = time_to(curves_of(runs, Along::time, &ErrorPoint::flip), flip_target, 0, false);
    return figures;
}

ErrorsAt errors_at(const Study& study, const StudyScene& scene, const StudyMethod& method, double seconds)
{
    const Runs runs = runs_of(study, scene.name, method.name);
    const auto middle = [&](double ErrorPoint::*error) {
        std::vector<double> errors = errors_of(curves_of(runs, Along::time, error), seconds);
        const bool all = std::none_of(errors.begin(), errors.end(), [](double e) { return std::isnan(e); });
        return all && !errors.empty() ? median(std::move(errors)) : no_number;
    };
    return {seconds,
            middle(&ErrorPoint::rmse),
            middle(&ErrorPoint::relmse),
            middle(&ErrorPoint::relmse_trimmed),
            middle(&ErrorPoint::smape),
            middle(&ErrorPoint::flip)};
}

}  // namespace lancer
