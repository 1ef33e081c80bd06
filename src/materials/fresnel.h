// Reflectance of the boundary between two dielectrics. Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed.,
// section 9.3.5, rearranged so that nothing cancels as the index tends to 1.
#pragma once

#include <algorithm>
#include <cmath>

namespace lancer {

struct Fresnel {
    float reflectance;  // of unpolarised light, in [0, 1]; transmittance is 1 - reflectance
    float cos_t;        // of the refracted direction, >= 0; 0 under total internal reflection
};

// cos_i: in [0, 1]; eta: index beyond the boundary over index before it, > 0. In double: for an index far from 1 the
// angles that are not reflected totally are so few that float cannot tell g^2 from 0.
inline Fresnel fresnel_dielectric(float cos_i, float eta)
{
    // g = eta cos_t, from g^2 = cos_i^2 + (eta^2 - 1). With k = eta^2 - 1 the amplitudes are
    // r_s = (cos_i - g) / (cos_i + g) = -k / (cos_i + g)^2 and
    // r_p = (eta^2 cos_i - g) / (eta^2 cos_i + g) = k (cos_i (cos_i + g) - 1) / ((cos_i + g) (eta^2 cos_i + g)).
    const double c = cos_i, n = eta;
    const double k = (n - 1) * (n + 1);
    const double g2 = c * c + k;
    if (!(g2 > 0)) return {1, 0};
    const double g = std::sqrt(g2), sum = c + g;
    const double rs = k / (sum * sum);
    const double rp = k * (c * sum - 1) / (sum * (n * n * c + g));
    return {static_cast<float>(std::min(1.0, 0.5 * (rs * rs + rp * rp))), static_cast<float>(g / n)};
}

}  // namespace lancer
