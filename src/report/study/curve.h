// The error of one run as a curve over time or over samples. Between measurements it is a power law, a straight line in
// logarithms, as the error of Monte Carlo is.
#pragma once

#include <vector>

#include "report/study/results.h"

namespace lancer {

enum class Along { time, samples };  // wall seconds, samples per pixel

struct ErrorCurve {
    std::vector<double> x, y;  // x positive and ascending; y >= 0, may be infinite
    bool empty() const { return x.empty(); }
};

// The points of a run at which this error was measured. An error below 0, which an estimate with two references can
// give, becomes 0.
ErrorCurve curve_of(const StudyRun& run, Along along, double ErrorPoint::*error);

// The error at x; NaN before the first point and after the last.
double error_at(const ErrorCurve& curve, double x);

// The logarithm of the x from which on the error stays at or below this one: -infinity if it does so from the first
// point on, infinity if it does not at the last one. The curve is not empty, error > 0.
double log_reached(const ErrorCurve& curve, double error);

// The same beyond the last point, by the power law fitted to the last points (last_points()), and no further than the
// measurements span: infinity if it is further, or if the error does not fall.
double log_extrapolated(const ErrorCurve& curve, double error);

// The last points that are above an error of the same run, at most six: five doublings. Early ones are left out as few
// samples do not yet follow a law, those below as they are noise of the reference. limits: a curve of the same run over
// the same x.
ErrorCurve last_points(const ErrorCurve& curve, const ErrorCurve& limits, double limit);

}  // namespace lancer
