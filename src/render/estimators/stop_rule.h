// Adaptive sampling: when a pixel has enough samples. `confidence`: a pilot of 16 samples with its own random numbers
// estimates the variance, from which the number of samples follows; the pilot is not part of the picture. Stein, "A
// Two-Sample Test for a Linear Hypothesis Whose Power is Independent of the Variance", Annals of Mathematical
// Statistics 16(3), 1945. As the averaged samples do not decide when to stop, the mean stays unbiased. A rule that
// tests the averaged samples, such as the legacy rule, stops early where they happen to agree and misses thin bright
// features.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/film.h"
#include "core/hash.h"
#include "scene/description/render_settings.h"

namespace lancer {

enum class StopRule {
    never,
    confidence,   // of the mean luminance, from a pilot
    last_sample,  // when a sample, the fifth or a later one, is close to the mean; legacy
};

// The classic integrators with --legacy clamp each sample to [0, 1] and end pixels by the last sample.
inline bool clamps_samples(const RenderSettings& settings)
{
    return settings.legacy && is_classic(settings.integrator);
}
inline StopRule stop_rule(const RenderSettings& settings)
{
    if (!settings.stop) return StopRule::never;
    return clamps_samples(settings) ? StopRule::last_sample : StopRule::confidence;
}

// Seed of the pilots in a picture with this seed; their random numbers are independent of the picture's.
constexpr uint64_t pilot_seed(uint64_t seed) { return mix_bits(~seed); }

// Number of samples of a pixel after its pilot of samples_per_block samples: the smallest multiple of a block for which
// the 95 % confidence interval of the mean luminance is at most +- error * sqrt(mean^2 + 0.01). error: > 0. If a pilot
// sample was not finite, the result is the maximum.
inline uint32_t samples_for(const Pixel& pilot, double error)
{
    constexpr uint32_t all = std::numeric_limits<uint32_t>::max();
    if (pilot.n < samples_per_block) return all;
    constexpr double student = 2.131449546;  // 97.5 % quantile for 15 degrees of freedom
    const double n = pilot.n, mean = luminance(pilot.sum[0], pilot.sum[1], pilot.sum[2]) / n;
    const double variance = std::max(0.0, (pilot.sum_sq / n - mean * mean) * n / (n - 1));
    const double needed = student * student * variance / (error * error * (mean * mean + 0.01));
    const double blocks = std::max(1.0, std::ceil(needed / samples_per_block));
    return blocks < double{all / samples_per_block} ? static_cast<uint32_t>(blocks) * samples_per_block : all;
}

// Whether the pixel ends with `last`, which its sums already contain; never with a sample that is not finite.
inline bool ends_with(const Pixel& pixel, Color last)
{
    if (pixel.n < 5) return false;
    const Color d = pixel.mean() - last;
    return std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b)}) < 0.005f * static_cast<float>(pixel.n);
}

}  // namespace lancer
