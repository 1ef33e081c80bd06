#include "harness/pairs.h"

namespace lancer::bench {

double error_of(const Pair& pair, const std::vector<const Pair*>& all)
{
    double sum = 0;
    for (size_t i = 0; i < pair[0].pixels.size(); ++i) {
        const Color a = pair[0].pixels[i].mean(), b = pair[1].pixels[i].mean();
        Color r;
        for (const Pair* p : all)
            for (const Film& film : *p) r += film.pixels[i].mean() / static_cast<float>(2 * all.size());
        const auto part = [](float x, float y, float z) {
            const double d = static_cast<double>(x) - static_cast<double>(y), m = static_cast<double>(z);
            return d * d / 2 / (m * m + 0.01);
        };
        sum += part(a.r, b.r, r.r) + part(a.g, b.g, r.g) + part(a.b, b.b, r.b);
    }
    return sum / (3 * static_cast<double>(pair[0].pixels.size()));
}

}  // namespace lancer::bench
