#include "report/page/plot_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace lancer {
namespace {

// mantissa * 10^exponent, the double that is nearest: 3 * 0.1 is another.
double decimal(double mantissa, int exponent)
{
    return std::strtod((std::to_string(static_cast<long long>(mantissa)) + "e" + std::to_string(exponent)).c_str(),
                       nullptr);
}

int floor_log10(double x) { return static_cast<int>(std::floor(std::log10(x))); }

Axis make_linear(double low, double high)
{
    const double size = std::max(std::abs(low), std::abs(high));
    if (high - low <= 1e-9 * size || size == 0) {  // nothing to tell apart
        const double room = size == 0 ? 1 : size / 2;
        low -= room, high += room;
    }
    constexpr double about = 6;  // intervals
    const double rough = (high - low) / about;
    const int exponent = floor_log10(rough);
    const double mantissa = rough / std::pow(10, exponent);
    const double step = mantissa <= 1 ? 1 : mantissa <= 2 ? 2 : mantissa <= 5 ? 5 : 10;
    const double unit = step * std::pow(10, exponent);
    // A value that is a tick but for its rounding needs none beyond it.
    const double first = std::floor(low / unit + 1e-9), last = std::ceil(high / unit - 1e-9);
    Axis axis{Scale::linear, 0, 0, {}};
    for (double i = first; i <= last; ++i) axis.ticks.push_back(decimal(i * step, exponent));
    axis.low = axis.ticks.front(), axis.high = axis.ticks.back();
    return axis;
}

// Powers of ten, with 2 and 5 times them where there are few.
Axis make_logarithmic(double low, double high)
{
    const double decades = std::log10(high) - std::log10(low);
    const int stride = decades > 10 ? static_cast<int>(std::ceil(decades / 8)) : 1;
    const std::vector<double> mantissas = decades < 2.5 ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
    Axis axis{Scale::logarithmic, 0, 0, {}};
    for (int exponent = floor_log10(low) - stride; axis.ticks.size() < 2 || axis.ticks.back() < high * (1 - 1e-9);
         exponent += stride) {
        for (const double mantissa : mantissas) {
            const double tick = decimal(mantissa, exponent);
            if (tick <= 0) continue;  // below the smallest double
            if (tick <= low * (1 + 1e-9)) axis.ticks.clear();
            axis.ticks.push_back(tick);
            if (tick >= high * (1 - 1e-9) && axis.ticks.size() > 1) break;
        }
    }
    axis.low = axis.ticks.front(), axis.high = axis.ticks.back();
    return axis;
}

}  // namespace

bool fits(Scale scale, double value) { return std::abs(value) <= 1e290 && (scale == Scale::linear || value >= 1e-290); }

Axis make_axis(Scale scale, double low, double high)
{
    return scale == Scale::linear ? make_linear(low, high) : make_logarithmic(low, high);
}

double place(const Axis& axis, double value)
{
    if (axis.scale == Scale::linear) return (value - axis.low) / (axis.high - axis.low);
    return (std::log10(value) - std::log10(axis.low)) / (std::log10(axis.high) - std::log10(axis.low));
}

}  // namespace lancer
