// Reflectance of the boundary between two dielectrics. Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed.,
// section 9.3.5, rearranged so that nothing cancels as the index tends to 1.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/vec.h"

namespace lancer {

struct Fresnel {
    float reflectance;  // of unpolarised light, in [0, 1]; transmittance is 1 - reflectance
    float cos_t;        // of the refracted direction, >= 0; 0 under total internal reflection
};

// cos_i and sin2_i, cosine and squared sine of one angle, each with its own full precision; eta: index beyond the
// boundary over index before it, > 0. In double: for an index far from 1 the angles that are not reflected totally are
// so few that float cannot tell g^2 from 0.
inline Fresnel fresnel_dielectric(double cos_i, double sin2_i, double eta)
{
    // g = eta cos_t, from g^2 = cos_i^2 + (eta^2 - 1) = eta^2 - sin_i^2: the one that cancels less. With
    // k = eta^2 - 1 the amplitudes are
    // r_s = (cos_i - g) / (cos_i + g) = -k / (cos_i + g)^2 and
    // r_p = (eta^2 cos_i - g) / (eta^2 cos_i + g) = k (cos_i g - sin_i^2) / ((cos_i + g) (eta^2 cos_i + g)).
    const double k = (eta - 1) * (eta + 1);
    const double g2 = sin2_i < 0.5 ? eta * eta - sin2_i : cos_i * cos_i + k;
    if (!(g2 > 0)) return {1, 0};
    const double g = std::sqrt(g2), sum = cos_i + g;
    const double rs = k / (sum * sum);
    const double rp = k * (cos_i * g - sin2_i) / (sum * (eta * eta * cos_i + g));
    return {static_cast<float>(std::min(1.0, 0.5 * (rs * rs + rp * rp))), static_cast<float>(g / eta)};
}

// cos_i: in [0, 1].
inline Fresnel fresnel_dielectric(float cos_i, float eta)
{
    const double c = cos_i;
    return fresnel_dielectric(c, (1 - c) * (1 + c), eta);
}

// wo: unit, local, z > 0.
inline Fresnel fresnel_dielectric(Vec3 wo, float eta)
{
    const double x = wo.x, y = wo.y;
    return fresnel_dielectric(std::min(1.0, static_cast<double>(wo.z)), x * x + y * y, eta);
}

}  // namespace lancer
