// GGX by its definition, in long double; and pairs of directions to try it on, near the mirrored one.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "materials/microfacet.h"
#include "support/random.h"

namespace lancer {

inline Vec3 direction(double cos, double phi)
{
    const double r = std::sqrt((1 - cos) * (1 + cos));
    return to_float(Vec3d{r * std::cos(phi), r * std::sin(phi), cos});
}

struct Long {
    long double x, y, z;
};
inline Long unit(Vec3 w)
{
    const long double x = w.x, y = w.y, z = w.z, l = std::sqrt(x * x + y * y + z * z);
    return {x / l, y / l, z / l};
}

// Walter et al. 2007, equations 33 and 34, with tangents of angles.
inline long double exact_density(Long h, long double alpha)
{
    const long double tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z), cos4 = h.z * h.z * h.z * h.z;
    const long double s = alpha * alpha + tan2;
    return alpha * alpha / (std::numbers::pi_v<long double> * cos4 * s * s);
}
inline long double exact_lambda(Long w, long double alpha)
{
    const long double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

struct Pair {
    Vec3 wo, wi;
};
// wi a few widths of the lobe around the mirrored direction. In memory, and only then looked at: g++ 12 optimises away
// a rounding to float between two calculations in double.
inline std::vector<Pair> pairs_of(float alpha)
{
    Random random(1);
    std::vector<Pair> all;
    for (const double cos : {1.0, 0.7, 0.1, 0.01, 1e-4})
        for (int i = 0; i < 2000; ++i) {
            const Vec3 wo = direction(cos, 1.0);
            const double lean = random.log_uniform(-2, 1) * static_cast<double>(alpha), turn = random.uniform(0, 7);
            const Vec3d h = normalize(Vec3d{lean * std::cos(turn), lean * std::sin(turn), 1});
            const Vec3 wi = to_float(mirrored(to_double(wo), h));
            if (wi.z > 0) all.push_back({wo, wi});
        }
    return all;
}

}  // namespace lancer
