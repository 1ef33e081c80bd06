// Sweeps beside rows A of the stability matrix.
#include <cmath>

#include "core/film.h"
#include "stability/sweep.h"

namespace lancer::stability {
namespace {

double relative_error(double mean, double expected) { return std::abs(mean / expected - 1); }

// Samples of one value: what the mean is off by, summed as the film does and in float.
Sweep film_sums()
{
    constexpr float value = 0.1f;
    SweepCurve film{"film: double, in blocks of 16", {}}, single{"float", {}};
    Pixel whole, block;
    float sum = 0;
    uint32_t n = 0;
    for (int log2n = 4; log2n <= 26; ++log2n) {
        for (const uint32_t stop = 1u << log2n; n < stop;) {
            block += Pixel{{double{value}, double{value}, double{value}}, 0, 1};
            sum += value;
            if (++n % samples_per_block == 0) whole += block, block = {};
        }
        film.points.push_back({double(n), relative_error(whole.sum[0] / n, double{value})});
        single.points.push_back({double(n), relative_error(double{sum} / n, double{value})});
    }
    return {"Sums of a pixel's samples", "samples of a pixel", "relative error of the mean of 0.1", {film, single}};
}

}  // namespace

std::vector<Sweep> film_sweeps() { return {film_sums()}; }

}  // namespace lancer::stability
