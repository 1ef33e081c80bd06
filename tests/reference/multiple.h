// Multiple scattering between rough facets, in double: two even lobes that give back what single scattering loses, as
// docs/integrators.md says. What is lost is found here by a quadrature of its own.
#pragma once

#include <array>

#include "reference/vector.h"

namespace reference {

enum class FacetsOf { metal, glass, sheet };

// Mean over even light, weighted by the cosine.
template <class F>
auto under_even_light(const F& what)
{
    constexpr int slices = 20000;
    decltype(what(1.0)) sum{};
    for (int i = 0; i < slices; ++i) {
        const double s = (i + 0.5) / slices, cos = s * s;
        sum += what(cos) * (2 * cos * 2 * s / slices);
    }
    return sum;
}

// The part of white light that facets lose, by the cosine; its mean under even light.
class FacetLoss {
public:
    // index: beyond the surface over before it; of a sheet that of its glass.
    FacetLoss(FacetsOf what, double index, double alpha);
    double at(double cos) const;
    double mean() const { return mean_; }
    double through() const { return through_; }  // what the smooth surface lets through of even light

private:
    static constexpr int steps = 128;
    std::array<double, steps + 1> loss_{};  // at the cosines (i / steps)^2
    double mean_ = 0, through_ = 0;
};

// The lobes of one surface.
struct EvenLobes {
    const FacetLoss* here = nullptr;    // of light from the side of wo; none: there are no such lobes
    const FacetLoss* beyond = nullptr;  // from the other side
    Rgb color{};                        // of both
    double through = 0;                 // part of what is lost that leaves on the other side
    double squared = 1;                 // of the index beyond over before: by as much radiance is less

    // f |cos(wi)|.
    Rgb eval(Vec wo, Vec wi) const;
};
// color: what a facet sends on. index as above.
EvenLobes even_lobes(FacetsOf what, double index, double alpha, Rgb color);

}  // namespace reference
