// Numbers between key frames. The smooth curve is the cubic spline of Catmull and Rom, 1974, for keys at any times: its
// slope at a key is that between its neighbours. At the first and the last key it is the slope to the next one, so that
// keys at constant speed stay at constant speed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace lancer {

// Where a time lies among keys: between key `at` and the next one, a part u in [0, 1) of the way; u = 0 at a key.
// Before the first key that one, after the last key that one. times: ascending, not empty.
struct KeyPlace {
    size_t at = 0;
    double u = 0;
};
inline KeyPlace place_among(std::span<const double> times, double time)
{
    if (!(time > times.front())) return {};
    if (!(time < times.back())) return {times.size() - 1, 0};
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    const auto at = static_cast<size_t>(after - times.begin()) - 1;
    return {at, (time - times[at]) / (times[at + 1] - times[at])};
}

// values: parallel to times.
inline double linear_at(std::span<const double> values, KeyPlace place)
{
    if (place.u == 0) return values[place.at];
    return values[place.at] + (values[place.at + 1] - values[place.at]) * place.u;
}

inline double smooth_at(std::span<const double> times, std::span<const double> values, KeyPlace place)
{
    if (place.u == 0) return values[place.at];
    const auto slope = [&](size_t key) {
        const size_t a = key == 0 ? 0 : key - 1, b = std::min(key + 1, times.size() - 1);
        return (values[b] - values[a]) / (times[b] - times[a]);
    };
    const size_t i = place.at;
    const double u = place.u, step = times[i + 1] - times[i], rise = values[i + 1] - values[i];
    // What the slopes add to the straight line, by Hermite's polynomials.
    const double begin = slope(i) * step - rise, end = slope(i + 1) * step - rise;
    return values[i] + rise * u + u * (1 - u) * ((1 - u) * begin - u * end);
}

}  // namespace lancer
