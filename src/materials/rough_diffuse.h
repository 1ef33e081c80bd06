// Diffuse reflection of a rough surface, which keeps all light of a white one: the energy-preserving Oren-Nayar model
// of Portsmouth, Kutz and Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025. Its first
// part is Fujii's improved Oren-Nayar model; the second brings back what that loses, evenly, coloured by the number of
// reflections.
#pragma once

#include "core/elementary.h"
#include "materials/spectrum.h"

namespace lancer {

// T: float or Float4.
template <class T>
class RoughDiffuseT {
public:
    using Spectrum = SpectrumOf<T>;

    // roughness: in [0, 1]; 0 is Lambert's.
    explicit RoughDiffuseT(T roughness)
        : roughness_(roughness), even_(1.0f / (1.0f + (0.5f - 2 / (3 * pi)) * roughness))
    {
    }

    // f of a surface of this albedo. Both directions unit, z > 0.
    Spectrum eval(const Spectrum& albedo, const Vec3T<T>& wo, const Vec3T<T>& wi) const
    {
        const T s = wo.x * wi.x + wo.y * wi.y;  // sine times sine times the cosine of the azimuth between them
        const T towards = select(s > 0.0f, s / larger(wo.z, wi.z), s);
        const T once = even_ * (1.0f + roughness_ * towards);
        const T mean = even_ * (1.0f + (2.0f / 3 - 28 / (15 * pi)) * roughness_);
        const T lost = (1.0f - this->albedo(wo.z)) * (1.0f - this->albedo(wi.z)) / larger(T{} + 1e-7f, 1.0f - mean);
        return each(albedo, [&](T rho) {
            return (rho * once + rho * rho * mean / (1.0f - rho * (1.0f - mean)) * lost) * (1 / pi);
        });
    }
    // Of the first part of a white surface, for light from a direction of this cosine in (0, 1].
    T albedo(T cos) const
    {
        const T one = T{} + 1.0f, c = smaller(one, cos), sin = sqrt((1.0f - c) * (1.0f + c));
        const T angle = arc_cosine(c);
        const T g = sin * (angle - sin * c) + 2.0f / 3 * (sin / c * (1.0f - sin * sin * sin) - sin);
        return smaller(one, even_ * (1.0f + roughness_ / pi * g));
    }

private:
    T roughness_, even_;
};
using RoughDiffuse = RoughDiffuseT<float>;

}  // namespace lancer
