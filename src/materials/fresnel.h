// Fresnel reflectance of dielectrics and metals. Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed.,
// sections 9.3.5 and 9.3.6, rearranged so that nothing cancels as the index tends to 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/color.h"
#include "core/lanes/vec.h"

namespace lancer {

template <class T>
struct FresnelT {
    T reflectance;  // of unpolarised light, in [0, 1]; transmittance is 1 - reflectance
    T cos_t;        // of the refracted direction, >= 0; 0 under total internal reflection
};
using Fresnel = FresnelT<float>;

// cos_i and sin2_i: cosine and squared sine of the same angle, both at full precision; eta: index beyond the boundary
// over index before it, > 0. In double: for an index far from 1 so few angles are refracted that float cannot
// distinguish g^2 from 0. D: double or a vector of them.
template <class D>
inline FresnelT<D> fresnel_dielectric_double(D cos_i, std::type_identity_t<D> sin2_i, std::type_identity_t<D> eta)
{
    // g = eta cos_t, from g^2 = cos_i^2 + (eta^2 - 1) = eta^2 - sin_i^2: the one that cancels less. With
    // k = eta^2 - 1 the amplitudes are
    // r_s = (cos_i - g) / (cos_i + g) = -k / (cos_i + g)^2 and
    // r_p = (eta^2 cos_i - g) / (eta^2 cos_i + g) = k (cos_i g - sin_i^2) / ((cos_i + g) (eta^2 cos_i + g)).
    const D k = (eta - 1.0) * (eta + 1.0), one = D{} + 1.0;
    const D g2 = select(sin2_i < 0.5, eta * eta - sin2_i, cos_i * cos_i + k);
    const auto is_refracted = g2 > 0.0;
    const D g = sqrt(g2), sum = cos_i + g;
    const D rs = k / (sum * sum);
    const D rp = k * (cos_i * g - sin2_i) / (sum * (eta * eta * cos_i + g));
    return {select(is_refracted, smaller(one, 0.5 * (rs * rs + rp * rp)), one), select(is_refracted, g / eta, D{})};
}
inline Fresnel fresnel_dielectric(double cos_i, double sin2_i, double eta)
{
    const auto [reflectance, cos_t] = fresnel_dielectric_double(cos_i, sin2_i, eta);
    return {static_cast<float>(reflectance), static_cast<float>(cos_t)};
}

// cos_i: in [0, 1].
inline Fresnel fresnel_dielectric(float cos_i, float eta)
{
    const double c = cos_i;
    return fresnel_dielectric(c, (1 - c) * (1 + c), eta);
}

// wo: unit, local, z > 0.
inline Fresnel fresnel_dielectric(Vec3 wo, double eta)
{
    const double x = wo.x, y = wo.y;
    return fresnel_dielectric(std::min(1.0, static_cast<double>(wo.z)), x * x + y * y, eta);
}

// A boundary without Fresnel reflection, for teaching; total internal reflection remains.
inline Fresnel only_refracting(Fresnel f) { return {f.cos_t > 0 ? 0.0f : 1.0f, f.cos_t}; }

// Reflectance of a metal with complex index eta + i k relative to the outside, for unpolarised light. eta, k >= 0;
// cos_i in [0, 1].
template <class D>
inline D fresnel_conductor(D cos_i, std::type_identity_t<D> eta, std::type_identity_t<D> k)
{
    const D one = D{} + 1.0, cos2 = cos_i * cos_i, sin2 = (1.0 - cos_i) * (1.0 + cos_i);
    // (a + i b)^2 = (eta + i k)^2 - sin^2, and r_s = (cos - a - i b) / (cos + a + i b).
    const D real = select(sin2 < 0.5, (eta - k) * (eta + k) - sin2, cos2 + (eta - 1.0) * (eta + 1.0) - k * k);
    const D imaginary = 2.0 * eta * k;
    const D sum = sqrt(real * real + imaginary * imaginary);  // a^2 + b^2
    // The form of a^2 = (sum + real) / 2 that does not cancel.
    const D a2 = select(real >= 0.0, 0.5 * (sum + real), 0.5 * imaginary * imaginary / (sum - real));
    const D a = sqrt(a2);
    const D across = 2.0 * a * cos_i, s = sum + cos2;
    const D along = across * sin2, p = cos2 * sum + sin2 * sin2;
    const D rs = (s - across) / (s + across), rp = (p - along) / (p + along);
    // At grazing incidence the limit.
    const auto has_quotients = (s + across > 0.0) & (p + along > 0.0);
    return select(has_quotients, smaller(one, larger(D{}, 0.5 * rs * (1.0 + rp))), one);
}
// The same per channel, rounded. Spectrum: Color, or colours of several points.
template <class Spectrum, class D>
inline Spectrum conductor_reflectance(const Spectrum& eta, const Spectrum& k, D cos)
{
    const auto& [er, eg, eb] = eta;
    const auto& [kr, kg, kb] = k;
    return {to_float(fresnel_conductor(cos, to_double(er), to_double(kr))),
            to_float(fresnel_conductor(cos, to_double(eg), to_double(kg))),
            to_float(fresnel_conductor(cos, to_double(eb), to_double(kb)))};
}

// The weight of white in Schlick's approximation. m: 1 - cos.
template <class T>
inline T schlick_weight(T m)
{
    const T m2 = m * m;
    return m2 * m2 * m;
}
// Schlick's approximation, from the reflectance at normal incidence to 1 at grazing.
template <class Spectrum, class D>
inline Spectrum fresnel_schlick(const Spectrum& f0, D cos_i)
{
    const auto m = to_float(1.0 - smaller(D{} + 1.0, larger(D{}, cos_i)));
    const auto w = schlick_weight(m);
    return f0 * (1.0f - w) + Spectrum{w, w, w};
}
// Its cosine-weighted mean over the hemisphere.
inline Color mean_schlick(Color f0) { return f0 * (20.0f / 21) + Color{1, 1, 1} * (1.0f / 21); }

}  // namespace lancer
