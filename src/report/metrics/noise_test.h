// Statistical tests of whether two pictures differ by more than their noise, given the variance of each pixel. Three
// tests of luminance differences: per pixel; in tiles of 8 x 8, after Jung, Hanika, Dachsbacher, "Detecting Bias in
// Monte Carlo Renderers using Welch's t-test", JCGT 9(2), 2020; and the mean of the whole picture. The pictures must
// have independent random numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/image.h"
#include "report/metrics/statistics.h"

namespace lancer {

// A picture and the variance of each pixel's mean luminance. With an upper estimate of the variance, as for Sobol'
// points, the tests are conservative.
struct NoisyPicture {
    const Image& image;
    std::span<const float> variance;  // as Image::pixels
    double rounding;                  // relative rounding error of values: 2^-24 for floats, 2^-11 for halfs
    double samples = 0;               // per pixel; 0: not known
};

// In pixels and tiles a picture with few samples often lacks rare bright samples and underestimates its variance. If
// both numbers of samples are known, each picture therefore has at least the variance that the other one predicts; this
// assumes that both are made in the same way.
struct NoiseTest {
    // Pixels whose variance is more than rounding explains, z the difference over its standard deviation. Of the same
    // mean, about 0.27 % have |z| > 3 and chi_square is about `pixels`; less where the variance is an upper estimate,
    // and more beyond 3 where pixels have a dozen samples or less.
    size_t pixels = 0, beyond_3 = 0, beyond_10 = 0;
    double chi_square = 0;  // sum of z^2

    // The others: a difference there is no noise.
    size_t quiet = 0, quiet_differing = 0;  // by more than `detectable`
    double quiet_difference = 0;            // the largest

    // Means over all pixels, in luminance; 95 %.
    double reference_mean = 0, difference = 0;
    double standard_error = 0;  // of the difference
    Interval interval;
    // A difference of the true means this large, or larger, is found in 80 of 100 tries or more.
    double detectable = 0;
    bool means_differ() const { return !interval.contains(0); }

    // Tiles with noise. Of pictures made in the same way, with the same samples per pixel, any of them goes beyond the
    // limit in 1 of 100 tries or fewer; in others, rare bright samples may do it.
    size_t tiles = 0, tiles_beyond = 0;
    double tile_limit = 0, largest_tile_z = 0;
    int32_t tile_x = 0, tile_y = 0;  // the first pixel of the tile with the largest |z|
    double tile_detectable = 0;      // as `detectable`, of the tile in the middle of all, relative to its mean

    size_t left_out = 0;  // pixels without a finite value or variance
};

// Throws as compare() of metrics.h, also if a variance is not of the size of its picture.
NoiseTest test_noise(const NoisyPicture& picture, const NoisyPicture& reference);

}  // namespace lancer
