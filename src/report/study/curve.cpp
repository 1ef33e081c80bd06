#include "report/study/curve.h"

#include <algorithm>
#include <cmath>

#include "report/metrics/statistics.h"

namespace lancer {
namespace {

constexpr size_t most_fitted = 6;
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

ErrorCurve curve_of(const StudyRun& run, Along along, double ErrorPoint::*error)
{
    ErrorCurve curve;
    for (const ErrorPoint& p : run.points) {
        const double x = along == Along::time ? p.wall_s : p.spp;
        // Not a number, or no progress since the last point: nothing that a logarithm could show.
        if (!(x > 0) || std::isnan(p.*error) || (!curve.empty() && x <= curve.x.back())) continue;
        curve.x.push_back(x);
        curve.y.push_back(std::max(p.*error, 0.0));
    }
    return curve;
}

double error_at(const ErrorCurve& curve, double x)
{
    if (curve.empty() || !(x >= curve.x.front() && x <= curve.x.back())) return no_number;
    const auto after = std::lower_bound(curve.x.begin(), curve.x.end(), x);
    const auto i = static_cast<size_t>(after - curve.x.begin());
    if (curve.x[i] == x) return curve.y[i];
    // No law leads to zero or from infinity: the worse of the two holds until the next point.
    const double a = curve.y[i - 1], b = curve.y[i];
    if (!(std::min(a, b) > 0) || !std::isfinite(std::max(a, b))) return std::max(a, b);
    const double part = std::log(x / curve.x[i - 1]) / std::log(curve.x[i] / curve.x[i - 1]);
    return a * std::pow(b / a, part);
}

double log_reached(const ErrorCurve& curve, double error)
{
    const auto above = std::find_if(curve.y.rbegin(), curve.y.rend(), [&](double y) { return y > error; });
    if (above == curve.y.rend()) return -infinity;
    if (above == curve.y.rbegin()) return infinity;
    const auto next = static_cast<size_t>(curve.y.rend() - above);
    const double a = curve.y[next - 1], b = curve.y[next];
    if (b == 0 || !std::isfinite(a)) return std::log(curve.x[next]);
    const double part = std::log(a / error) / std::log(a / b);
    return std::log(curve.x[next - 1]) + part * std::log(curve.x[next] / curve.x[next - 1]);
}

double log_extrapolated(const ErrorCurve& curve, double error)
{
    const double reached = log_reached(curve, error);
    const ErrorCurve last = last_points(curve, curve, 0);
    if (reached != infinity || last.x.size() < 3 || !std::isfinite(curve.y.back())) return reached;
    const double exponent = fitted_exponent(last.x, last.y);
    if (!(exponent < 0)) return infinity;
    const double further = std::log(error / curve.y.back()) / exponent;
    return further <= std::log(curve.x.back() / curve.x.front()) ? std::log(curve.x.back()) + further : infinity;
}

ErrorCurve last_points(const ErrorCurve& curve, const ErrorCurve& limits, double limit)
{
    ErrorCurve last;
    for (size_t i = curve.x.size(); i-- > 0 && last.x.size() < most_fitted;) {
        const double other = error_at(limits, curve.x[i]);
        if (!(other > limit) || !(curve.y[i] > 0) || !std::isfinite(curve.y[i])) continue;
        last.x.push_back(curve.x[i]);
        last.y.push_back(curve.y[i]);
    }
    std::reverse(last.x.begin(), last.x.end());
    std::reverse(last.y.begin(), last.y.end());
    return last;
}

}  // namespace lancer
