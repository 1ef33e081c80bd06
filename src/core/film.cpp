#include "core/film.h"

#include <algorithm>

namespace lancer {

uint64_t samples_wanted(const Film& film, uint32_t spp)
{
    if (film.wanted.empty()) return uint64_t{spp} * film.pixels.size();
    uint64_t sum = 0;
    for (const uint32_t n : film.wanted) sum += n == 0 ? spp : std::min(n, spp);
    return sum;
}

double estimate_rel_mse(const Film& film)
{
    double sum = 0;
    uint64_t counted = 0;
    for (const Pixel& p : film.pixels) {
        if (p.n < 2) continue;
        const double n = p.n;
        const double mean = luminance(p.sum[0], p.sum[1], p.sum[2]) / n;
        const double variance = std::max(0.0, (p.sum_sq / n - mean * mean) * n / (n - 1));
        sum += variance / n / (mean * mean + 0.01);
        ++counted;
    }
    return counted ? sum / static_cast<double>(counted) : 0;
}

}  // namespace lancer
