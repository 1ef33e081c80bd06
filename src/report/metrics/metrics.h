// Errors of a picture against a reference, in linear radiance before any tone mapping. Sums are in double and in a
// fixed order: the same pictures give the same figures everywhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"

namespace lancer {

// Added to r^2 in relative errors, so that dark pixels do not dominate.
inline constexpr double relmse_epsilon = 0.01;

inline std::array<double, 3> channels(Color c)
{
    return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
}

// A pixel that is not finite on either side has infinite error, in smape 1: rmse and relmse are then infinite, never
// NaN, so a comparison with a limit fails as it should.
struct Metrics {
    double rmse = 0;            // root of the mean over pixels and channels of (x - r)^2
    double relmse = 0;          // mean over pixels and channels of (x - r)^2 / (r^2 + 0.01)
    double relmse_trimmed = 0;  // the same without the 0.1 % of pixels (rounded down) with the largest error
    double relmse_p99 = 0;      // the least error that 99 % of the pixels do not exceed, of each its mean over channels
    double smape = 0;           // mean over pixels and channels of |x - r| / (|x| + |r|), of 0 and 0 none: 0 to 1
    std::array<double, 3> mean = {}, reference_mean = {}, mean_ratio = {};  // each channel; ratio = mean / reference
    double max_difference = 0;                                              // largest |x - r| of any channel
    int32_t max_x = 0, max_y = 0;     // the pixel where it is, the first one in reading order
    size_t differing_pixels = 0;      // with different bits (0 and -0 differ)
    size_t non_finite_pixels = 0;     // of the picture
    size_t reference_non_finite = 0;  // pixels of the reference
};

// Throws Error(invalid_input), with the windows of both, if they are not the same or empty.
void require_same_windows(const Image& a, const Image& b);

// Throws as require_same_windows.
Metrics compare(const Image& x, const Image& reference);

// How many pixels differ by more than the limit in some channel; one that is not finite on either side does. Windows as
// for compare().
size_t pixels_beyond(double limit, const Image& x, const Image& reference);

// Each pixel's mean over its channels of (x - r)^2 / (r^2 + 0.01); infinite as above. Windows as for compare().
std::vector<double> relative_squared_errors(const Image& x, const Image& reference);

// The mean over pixels and channels of (x - r1)(x - r2) / (r1 r2 + 0.01), for two independent references: their noise
// averages out instead of adding to the error of x. Can be slightly negative.
double unbiased_squared_error(const Image& x, const Image& r1, const Image& r2);

}  // namespace lancer
