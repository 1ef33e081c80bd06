// A thin sheet of glass: both faces of a pane in one surface, without a shift. Light is reflected to and fro between
// the faces; the series of all orders is summed. The sum for an untinted pane stands in Pharr, Jakob, Humphreys,
// "Physically Based Rendering", 4th ed., section 9.5.3.
#pragma once

#include "core/color.h"
#include "materials/fresnel.h"

namespace lancer {

// Part of the light that a clear sheet reflects. r: reflectance of one of its faces, in [0, 1]; it is the same from
// both sides.
template <class D>
inline D reflectance_of_sheet(D r)
{
    return 2 * r / (1 + r);
}

// Part of the light that it reflects, or lets through.
template <class D>
inline D part_of_sheet(D r, bool through)
{
    return through ? (1 - r) / (1 + r) : reflectance_of_sheet(r);
}

inline Color least_of(Color a, Color b) { return {std::min(a.r, b.r), std::min(a.g, b.g), std::min(a.b, b.b)}; }
inline Color part_of_sheets(Color r, bool through)
{
    const auto part = [=](float x) { return static_cast<float>(part_of_sheet(double{x}, through)); };
    return {part(r.r), part(r.g), part(r.b)};
}

// What a tint changes: the light of both directions over that of a clear sheet. tint: the factor of each reflection and
// each refraction, as of a solid body; in [0, 1]. Without one both are 1.
struct SheetColors {
    Color reflected, transmitted;
};
inline SheetColors colors_of_sheet(double r, Color tint)
{
    // Of one channel c, with t = 1 - r for the transmittance of a face: a sheet reflects c r + c^3 t^2 r / (1 - c^2
    // r^2) and transmits c^2 t^2 / (1 - c^2 r^2). What both have in common with c = 1 is divided out.
    const double t = 1 - r;
    const auto reflected = [=](float channel) {
        const double c = channel, again = t > 0 ? c * c * t * t / ((1 - c * r) * (1 + c * r)) : 0;
        return static_cast<float>(c * (1 + again) * (1 + r) / 2);
    };
    const auto transmitted = [=](float channel) {
        const double c = channel;
        return t > 0 ? static_cast<float>(c * c * t * (1 + r) / ((1 - c * r) * (1 + c * r))) : 0;
    };
    return {{reflected(tint.r), reflected(tint.g), reflected(tint.b)},
            {transmitted(tint.r), transmitted(tint.g), transmitted(tint.b)}};
}

// Width of the lobe of transmitted light over that of the facets of one face, for a mirrored lobe of reflection. A
// facet of slope m turns what it reflects by 2 m and what it lets through by about |index - 1| m. The slopes of the two
// faces are independent; slopes of GGX have no variance, but the median of the length of the sum of two is 1.67 times
// that of one.
inline double spread_of_sheet(double index) { return std::min(1.0, 0.83 * std::abs(index - 1)); }

// Alpha of the lobe of reflected or of transmitted light.
inline double alpha_of_sheet(double alpha, double index, bool through)
{
    return through ? alpha * spread_of_sheet(index) : alpha;
}

}  // namespace lancer
