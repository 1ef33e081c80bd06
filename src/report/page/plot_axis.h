// An axis of a plot: a range that begins and ends at round numbers, ticks at round numbers, and where a value stands
// between its ends. Linear ticks are 1, 2 or 5 times a power of ten apart (Heckbert, Nice Numbers for Graph Labels,
// Graphics Gems 1990).
#pragma once

#include <vector>

namespace lancer {

enum class Scale { linear, logarithmic };

struct Axis {
    Scale scale = Scale::linear;
    double low = 0, high = 1;
    std::vector<double> ticks;  // ascending; the first is low, the last is high
};

// Whether a value can stand on such an axis: finite, not so large that differences overflow, positive on a logarithmic
// one.
bool fits(Scale scale, double value);

// The axis that shows all values from low to high, which must fit; low <= high. Where both are one value the axis has a
// length all the same.
Axis make_axis(Scale scale, double low, double high);

// 0 at the low end, 1 at the high one.
double place(const Axis& axis, double value);

}  // namespace lancer
