// Sampling of a triangle light: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.5.3. For one
// point and for several with the same bits.
#pragma once

#include "core/lanes/vec.h"

namespace lancer {

// T: float or several of them.
template <class T>
struct SeenTriangle {
    T d2;         // squared distance, scene units; if it is 0, the other members are NaN
    Vec3T<T> wi;  // unit, to the point
    T cos;        // between the light's normal and the direction to the point; < 0 behind the light

    // point: on the light, n: its unit normal; org: the illuminated point.
    [[gnu::always_inline]] SeenTriangle(const Vec3T<T>& point, const Vec3T<T>& n, const Vec3T<T>& org)
    {
        const Vec3T<T> d = point - org;
        d2 = dot(d, d);
        wi = d / sqrt(d2);
        cos = -dot(wi, n);
    }
    // Density, per solid angle at the illuminated point, of a uniform point on a triangle of this area.
    T pdf(T area) const { return d2 / (abs(cos) * area); }
};

}  // namespace lancer
