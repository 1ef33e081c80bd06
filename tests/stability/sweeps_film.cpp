// Sweeps beside rows A of the stability matrix.
#include <cmath>

#include "core/film.h"
#include "stability/sweep.h"
#include "support/random.h"

namespace lancer::stability {
namespace {

double relative_error(double sum, long double exact)
{
    return static_cast<double>(std::abs(static_cast<long double>(sum) / exact - 1));
}

// Samples from 0.05 to 0.15: what their mean is off by, summed as the film does and in float.
Sweep film_sums()
{
    SweepCurve film{"film: double, in blocks of 16", {}}, single{"float", {}};
    Pixel whole, block;
    float sum = 0;
    long double exact = 0;
    Random random(1);
    uint32_t n = 0;
    for (int log2n = 4; log2n <= 26; ++log2n) {
        for (const uint32_t stop = 1u << log2n; n < stop;) {
            const float value = 0.05f + 0.1f * random.unit();
            exact += static_cast<long double>(value);
            block += Pixel{{double{value}, double{value}, double{value}}, 0, 1};
            sum += value;
            if (++n % samples_per_block == 0) whole += block, block = {};
        }
        film.points.push_back({double(n), relative_error(whole.sum[0], exact)});
        single.points.push_back({double(n), relative_error(double{sum}, exact)});
    }
    return {"Sums of a pixel's samples", "samples of a pixel", "relative error of the mean", {film, single}};
}

}  // namespace

std::vector<Sweep> film_sweeps() { return {film_sums()}; }

}  // namespace lancer::stability
