// A point of a triangle of light as seen from a place: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed.,
// section 6.5.3. Once for one place and once for several, with the same bits.
#pragma once

#include "core/lanes/vec.h"

namespace lancer {

// T: float or several of them.
template <class T>
struct SeenTriangle {
    T d2;         // squared distance, scene units; where it is 0, what follows is NaN
    Vec3T<T> wi;  // unit, to the point
    T cos;        // between the normal of the light and the way to the place; < 0 behind the light

    // point: of the light, n: its normal, unit; org: the place.
    [[gnu::always_inline]] SeenTriangle(const Vec3T<T>& point, const Vec3T<T>& n, const Vec3T<T>& org)
    {
        const Vec3T<T> d = point - org;
        d2 = dot(d, d);
        wi = d / sqrt(d2);
        cos = -dot(wi, n);
    }
    // Density of a point that is uniform over the triangle of this area, per solid angle at the place.
    T pdf(T area) const { return d2 / (abs(cos) * area); }
};

}  // namespace lancer
