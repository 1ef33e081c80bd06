// Diffuse reflection of a rough surface, which keeps all light of a white one: the energy-preserving Oren-Nayar model
// of Portsmouth, Kutz and Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025. Its first
// part is Fujii's improved Oren-Nayar model; the second brings back what that loses, evenly, coloured by the number of
// reflections.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/color.h"
#include "core/vec.h"

namespace lancer {

class RoughDiffuse {
public:
    // roughness: in [0, 1]; 0 is Lambert's.
    explicit RoughDiffuse(float roughness) : roughness_(roughness), even_(1 / (1 + (0.5f - 2 / (3 * pi)) * roughness))
    {
    }

    // f of a surface of this albedo. Both directions unit, z > 0.
    Color eval(Color albedo, Vec3 wo, Vec3 wi) const
    {
        const float s = wo.x * wi.x + wo.y * wi.y;  // sine times sine times the cosine of the azimuth between them
        const float towards = s > 0 ? s / std::max(wo.z, wi.z) : s;
        const float once = even_ * (1 + roughness_ * towards);
        const float mean = even_ * (1 + (2.0f / 3 - 28 / (15 * pi)) * roughness_);
        const float lost = (1 - this->albedo(wo.z)) * (1 - this->albedo(wi.z)) / std::max(1e-7f, 1 - mean);
        const auto all = [&](float rho) {
            return (rho * once + rho * rho * mean / (1 - rho * (1 - mean)) * lost) * (1 / pi);
        };
        return {all(albedo.r), all(albedo.g), all(albedo.b)};
    }
    // Of the first part of a white surface, for light from a direction of this cosine in (0, 1].
    float albedo(float cos) const
    {
        const float c = std::min(1.0f, cos), sin = std::sqrt((1 - c) * (1 + c));
        const float angle = std::acos(c);
        const float g = sin * (angle - sin * c) + 2.0f / 3 * (sin / c * (1 - sin * sin * sin) - sin);
        return std::min(1.0f, even_ * (1 + roughness_ / pi * g));
    }

private:
    float roughness_, even_;
};

}  // namespace lancer
