// Sampling of a sphere light from outside: uniform in the cone that it subtends (Pharr, Jakob, Humphreys, "Physically
// Based Rendering", 4th ed., section 6.2.4), in double and with 1 - cos computed without cancellation, so that it holds
// for any distance. For one point and for several with the same bits.
#pragma once

#include "core/frame.h"
#include "core/warp.h"

namespace lancer {

// T: float or several of them.
template <class T>
struct PointOnSphere {
    Vec3T<T> wi;        // unit, towards the light
    Vec3T<T> point, n;  // n: unit, outwards
    T pdf;              // per solid angle
};

// to_center: from the point, longer than the radius. u: in [0, 1); phi: sin_cos_2pi() of another such number. D: the
// type of doubles for T.
template <class T, class D>
inline PointOnSphere<T> sphere_seen_from_outside(const Vec3T<D>& center, D radius, const Vec3T<D>& to_center, T u,
                                                 const SinCosT<T>& phi)
{
    const D d2 = dot(to_center, to_center), r2 = radius * radius;
    const D max = one_minus_cos(r2 / d2), v = square_to_cone(to_double(u), max);
    const D cos_theta = 1 - v, sin2_theta = v * (2 - v), d = sqrt(d2);
    const Vec3T<D> axis = to_center / d;
    const FrameT<T> frame(to_float(axis));
    const Vec3T<D> side = to_double(frame.x) * to_double(phi.cos) + to_double(frame.y) * to_double(phi.sin);
    const Vec3T<D> w = axis * cos_theta + side * sqrt(sin2_theta);
    const D t = d * cos_theta - sqrt(larger(D{}, r2 - d2 * sin2_theta));
    const Vec3T<D> n = normalize(w * t - to_center);
    return {.wi = to_float(normalize(w)),
            .point = to_float(center + n * radius),
            .n = to_float(n),
            .pdf = to_float(pdf_cone(max))};
}

}  // namespace lancer
