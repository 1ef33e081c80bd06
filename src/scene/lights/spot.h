// A point that sends light into a cone, with an edge that fades as the glTF extension KHR_lights_punctual has it: by
// the square of how far the cosine to the middle is between those of its two angles.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/description/light.h"
#include "scene/lights/bounds.h"
#include "scene/lights/light_sample.h"
#include "scene/placement.h"

namespace lancer {

struct SpotLight {
    static constexpr LightType type = LightType::spot;
    Vec3 position;  // scene units
    Vec3 axis;      // the way that its middle goes, unit
    float cos_inner, cos_outer;
    Color intensity;  // in the middle, per square scene unit

    static SpotLight make(const LightDescription& l, const Normalisation& n)
    {
        const auto cos_of = [](double deg) { return static_cast<float>(deg < 90 ? std::cos(deg * pi_d / 180) : 0); };
        const Vec3d way = l.direction / max_component(abs(l.direction));  // whose square is no 0 or infinity
        return {to_float(n.to_scene(l.position)), to_float(normalize(way)), cos_of(l.inner_deg), cos_of(l.outer_deg),
                l.power * static_cast<float>(n.scale * n.scale)};
    }
    // Part of the intensity along a unit vector away from the light.
    float fade(Vec3 away) const
    {
        const float cos = dot(away, axis);
        if (cos >= cos_inner) return 1;  // also where there is no edge between the two
        if (!(cos > cos_outer)) return 0;
        const float part = (cos - cos_outer) / (cos_inner - cos_outer);
        return part * part;
    }
    // From `org`, where the shadow ray will start.
    std::optional<LightSample> sample(Vec3 org) const
    {
        const Vec3 d = position - org;
        const float d2 = dot(d, d);
        if (!(d2 > 0)) return {};
        const Vec3 wi = d / std::sqrt(d2);
        const float left = fade(-wi);
        if (!(left > 0)) return {};
        return LightSample{.wi = wi, .point = position, .radiance = intensity * (left / d2), .pdf = 1, .delta = true};
    }
    // The integral of fade(): a whole cone and the mean of the square, a third, over the cosines between.
    double power(double) const
    {
        const double inner{cos_inner}, outer{cos_outer};
        return 2 * pi_d * (1 - inner + (inner - outer) / 3) * luminance(intensity.r, intensity.g, intensity.b);
    }
    std::optional<LightBounds> bounds() const
    {
        LightBounds b;
        b.normals = {to_double(axis), 0};
        b.box.grow(to_double(position));
        return b;
    }
    UndimmedLight undimmed(Vec3 org, double scale) const
    {
        const Vec3 way = position - org;
        const float distance = std::sqrt(dot(way, way));
        const float left = distance > 0 ? fade(way / -distance) : 0;
        return UndimmedLight{way, intensity * (left / static_cast<float>(scale * scale)), false};
    }
};

}  // namespace lancer
