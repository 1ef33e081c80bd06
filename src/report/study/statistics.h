// Statistics of a method on a scene over its seeds: median curves with bands, the rate of convergence, the time to an
// error, each with a 95 % interval by resampling the seeds (report/metrics/statistics.h). study/ranking.h compares
// methods.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/metrics/statistics.h"
#include "report/study/results.h"

namespace lancer {

// Target errors of the time to error, in relMSE.
inline constexpr std::array study_targets{1e-1, 1e-2, 1e-3};
// And of the time to a FLIP: differences that are seen when pictures alternate.
inline constexpr double flip_target = 0.1;

// At or below this relMSE at least half of the measured error is the reference's own noise.
inline double noise_limit(double reference_noise_relmse) { return 2 * reference_noise_relmse; }

// A slope is fitted above this relMSE: there the noise of the reference flattens the curve by less than a tenth.
inline double slope_limit(double reference_noise_relmse) { return 10 * reference_noise_relmse; }

// Of the reference that the method's errors are against: the scene's, or one of its own.
double reference_noise(const Study& study, const StudyScene& scene, const StudyMethod& method);

struct CurvePoint {
    double x = 0, median = 0;
    Interval band;
};

// The exponent of RMSE as a power of samples or seconds: plain Monte Carlo has -0.5.
struct Slope {
    double exponent = 0;  // the median of those of the runs, each over its last points (study/curve.h)
    Interval interval;
};

enum class Reach {
    measured,      // between two measurements
    extrapolated,  // beyond the last one, by the slope; only of unbiased methods
    at_once,       // before the first measurement; seconds is the time of that
    not_reached,
    below_noise,  // the reference is too noisy for this error
    not_measured  // no run
};
struct TimeToError {
    double target = 0;  // relMSE, or FLIP
    Reach reach = Reach::not_measured;
    double seconds = 0;  // of measured, extrapolated, at_once
    Interval interval;  // of measured and extrapolated; low 0: before the first measurement, high infinite: not reached
};

// Medians over the runs at one time.
struct ErrorsAt {
    double seconds = 0;
    double rmse = 0, relmse = 0, relmse_trimmed = 0, smape = 0, flip = 0;  // NaN: not measured
};

struct MethodFigures {
    const StudyMethod* method = nullptr;
    size_t runs = 0, failed = 0;            // failed ones are not among runs
    double first_s = 0, last_s = 0;         // the times that every run has measurements around; NaN without runs
    std::vector<CurvePoint> time, samples;  // relMSE over seconds, over samples per pixel
    std::optional<Slope> slope_samples, slope_time;
    std::vector<TimeToError> times;  // one for each of study_targets
    TimeToError flip_time;           // to flip_target
};

// Why there is no time that a method could be ranked by; empty of measured.
std::string why_no_time(Reach reach);

size_t failed_runs(const Study& study, const std::string& scene, const std::string& method);
// The runs of a method on a scene that did not fail and have measurements, by ascending seed.
std::vector<const StudyRun*> runs_of(const Study& study, const std::string& scene, const std::string& method);

// target: a relMSE, positive.
TimeToError time_to_error(const Study& study, const StudyScene& scene, const StudyMethod& method, double target);

// The pointers stay valid as long as the study. Curves over time have points at powers of the square root of two
// seconds, the same for all methods, and at both ends.
MethodFigures figures_of(const Study& study, const StudyScene& scene, const StudyMethod& method);

// seconds must lie within [first_s, last_s] of the method.
ErrorsAt errors_at(const Study& study, const StudyScene& scene, const StudyMethod& method, double seconds);

}  // namespace lancer
