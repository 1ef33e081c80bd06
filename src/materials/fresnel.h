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

// cos_i: in [0, 1]; eta: index beyond the boundary over index before it, > 0.
inline Fresnel fresnel_dielectric(float cos_i, float eta)
{
    // g = eta cos_t, from g^2 = cos_i^2 + (eta^2 - 1). With k = eta^2 - 1 the amplitudes are
    // r_s = (cos_i - g) / (cos_i + g) = -k / (cos_i + g)^2 and
    // r_p = (eta^2 cos_i - g) / (eta^2 cos_i + g) = k (cos_i (cos_i + g) - 1) / ((cos_i + g) (eta^2 cos_i + g)).
    const float k = (eta - 1) * (eta + 1);
    const float g2 = cos_i * cos_i + k;
    if (!(g2 > 0)) return {1, 0};
    const float g = std::sqrt(g2), sum = cos_i + g;
    const float rs = k / (sum * sum);
    const float rp = k * (cos_i * sum - 1) / (sum * (eta * eta * cos_i + g));
    return {std::min(1.0f, 0.5f * (rs * rs + rp * rp)), g / eta};
}

}  // namespace lancer
