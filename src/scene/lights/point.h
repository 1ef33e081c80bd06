// A point that sends the same light in all directions. Pharr, Jakob, Humphreys, 4th ed., section 12.2.
#pragma once

#include <optional>

#include "scene/description/light.h"
#include "scene/lights/bounds.h"
#include "scene/lights/light_sample.h"
#include "scene/placement.h"

namespace lancer {

struct PointLight {
    static constexpr LightType type = LightType::point;
    Vec3 position;    // scene units
    Color intensity;  // per square scene unit

    static PointLight make(const LightDescription& l, const Normalisation& n)
    {
        return {to_float(n.to_scene(l.position)), l.power * static_cast<float>(n.scale * n.scale)};
    }
    // From `org`, where the shadow ray will start.
    std::optional<LightSample> sample(Vec3 org) const
    {
        const Vec3 d = position - org;
        const float d2 = dot(d, d);
        if (!(d2 > 0)) return {};
        return LightSample{
            .wi = d / std::sqrt(d2), .point = position, .radiance = intensity / d2, .pdf = 1, .delta = true};
    }
    double power(double) const { return 4 * pi_d * luminance(intensity.r, intensity.g, intensity.b); }
    std::optional<LightBounds> bounds() const
    {
        LightBounds b;
        b.normals.angle = pi_d;
        b.box.grow(to_double(position));
        return b;
    }
    UndimmedLight undimmed(Vec3 org, double scale) const
    {
        return UndimmedLight{position - org, intensity / static_cast<float>(scale * scale), false};
    }
};

}  // namespace lancer
