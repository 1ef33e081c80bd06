// Parallel light from infinitely far away. Pharr, Jakob, Humphreys, 4th ed., section 12.3.
#pragma once

#include <optional>

#include "scene/description/light.h"
#include "scene/lights/bounds.h"
#include "scene/lights/light_sample.h"
#include "scene/placement.h"

namespace lancer {

struct DirectionalLight {
    static constexpr LightType type = LightType::directional;
    Vec3 wi;           // towards the light, unit
    Color irradiance;  // on a surface that faces it

    static DirectionalLight make(const LightDescription& l, const Normalisation&)
    {
        const Vec3d d = -l.direction / max_component(abs(l.direction));  // whose square is no 0 or infinity
        return {to_float(normalize(d)), l.power};
    }
    std::optional<LightSample> sample(Vec3) const
    {
        return LightSample{.wi = wi, .infinite = true, .radiance = irradiance, .pdf = 1, .delta = true};
    }
    double power(double area) const { return area * luminance(irradiance.r, irradiance.g, irradiance.b); }
    static std::optional<LightBounds> bounds() { return {}; }
    UndimmedLight undimmed(Vec3, double) const { return {wi, irradiance, true}; }
};

}  // namespace lancer
