// Fresnel's equations as optics books have them: amplitudes with a complex index. Born and Wolf, "Principles of
// Optics", 7th ed., sections 1.5.2 and 14.2.
#pragma once

#include <algorithm>
#include <complex>

#include "reference/vector.h"

namespace reference {

// Reflectance for unpolarised light. index: beyond over before; absorption as its positive imaginary part.
inline double reflectance(double cos, std::complex<double> index)
{
    const std::complex<double> n2 = index * index, bent = std::sqrt(n2 - (1 - cos * cos));
    const double s = std::norm((cos - bent) / (cos + bent));
    const double p = std::norm((n2 * cos - bent) / (n2 * cos + bent));
    return std::min(1.0, 0.5 * (s + p));
}

// Of a boundary without absorption. Below the critical angle the root is imaginary and both amplitudes have the
// magnitude 1.
inline double reflectance(double cos, double index) { return reflectance(cos, std::complex<double>(index, 0)); }

// The direction behind the boundary, by Snell's law in vectors; w: unit, n: unit, on w's side. Only where not all is
// reflected.
inline Vec refracted(Vec w, Vec n, double index)
{
    const Vec across = w - dot(w, n) * n, beyond = -1 / index * across;
    return beyond - std::sqrt(std::max(0.0, 1 - dot(beyond, beyond))) * n;
}

// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994.
inline Rgb schlick(Rgb normal, double cos) { return normal + (grey(1) - normal) * std::pow(1 - cos, 5); }

}  // namespace reference
