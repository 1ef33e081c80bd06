// Light sampling of an environment of one colour: by the cosine at the surface, which is all that varies.
#pragma once

#include "core/frame.h"
#include "core/warp.h"

namespace lancer {

// Density of direction wi per solid angle; ns: the shading normal. T: float or several of them.
template <class T>
T pdf_constant_environment(const Vec3T<T>& ns, const Vec3T<T>& wi)
{
    return pdf_cosine_hemisphere(dot(ns, wi));
}

template <class T>
struct ConstantEnvironmentSample {
    Vec3T<T> wi;  // unit
    T pdf;        // of the direction as it is after rounding, which is what a ray along it finds; 0 below the surface

    // u, v: in [0, 1).
    [[gnu::always_inline]] ConstantEnvironmentSample(const Vec3T<T>& ns, T u, T v)
        : wi(FrameT<T>(ns).to_world(square_to_cosine_hemisphere(u, v))), pdf(pdf_constant_environment(ns, wi))
    {
    }
};

}  // namespace lancer
