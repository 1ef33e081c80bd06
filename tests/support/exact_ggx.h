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
long double exact_density(Long h, long double alpha);
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
std::vector<Pair> pairs_of(float alpha);

}  // namespace lancer
