// Fresnel's equations as every book has them, in long double, whose mantissa bears that they cancel.
#pragma once

#include <cmath>

namespace lancer {

struct ExactFresnel {
    long double reflectance, cos_t;
};

inline ExactFresnel exact_fresnel(float cos_i_float, float eta_float)
{
    const long double cos_i = cos_i_float, eta = eta_float;
    // eta^2 cos_t^2 without a difference of nearly equal numbers as eta tends to 1.
    const long double g2 = (eta - 1) * (eta + 1) + cos_i * cos_i;
    if (g2 <= 0) return {1, 0};
    const long double cos_t = std::sqrt(g2) / eta;
    const long double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const long double p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return {(s * s + p * p) / 2, cos_t};
}

}  // namespace lancer
