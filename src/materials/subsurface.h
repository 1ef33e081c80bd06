// What is inside a body by how it looks: from the colour of a thick body to the albedo of a single scattering.
#pragma once

#include <cmath>

#include "core/color.h"

namespace lancer {

// Albedo of single scattering of a medium without end below a plane, without a boundary of its own, that reflects the
// part `diffuse` of even light: the inverse of
//     diffuse = (1 - s) (1 - 0.139 s) / (1 + 1.17 s),  s^2 = (1 - albedo) / (1 - g albedo),
// of van de Hulst, "Multiple Light Scattering", volume 2, 1980, as Kulla and Conty use it: "Revisiting Physically Based
// Shading at Imageworks", SIGGRAPH 2017 course. diffuse in [0, 1]; g: mean cosine of the phase function.
inline double albedo_of_scattering(double diffuse, double g)
{
    // 0.139 s^2 - (1.139 + 1.17 diffuse) s + 1 - diffuse = 0, by the form that does not cancel.
    const double half = 0.5 * (1.139 + 1.17 * diffuse), rest = 1 - diffuse;
    const double s = rest / (half + std::sqrt(half * half - 0.139 * rest));
    return (1 - s * s) / (1 - g * s * s);
}

struct Subsurface {
    Color scattering, absorption;  // per unit of the mean free path

    // color: of the light that enters a thick body under even light, the part that comes out again. radius: mean free
    // path of each channel, > 0. leaves: the part of even light that the surface lets out from within.
    Subsurface(Color color, Color radius, float g, double leaves)
    {
        const auto set = [&](float c, float r, float& s, float& a) {
            // The rest is reflected inwards and scattered once more, as below the coat of plastic.
            const double diffuse = double{c} / (leaves + (1 - leaves) * double{c});
            const double albedo = albedo_of_scattering(diffuse, double{g});
            s = static_cast<float>(albedo / double{r}), a = static_cast<float>((1 - albedo) / double{r});
        };
        set(color.r, radius.r, scattering.r, absorption.r);
        set(color.g, radius.g, scattering.g, absorption.g);
        set(color.b, radius.b, scattering.b, absorption.b);
    }
};

}  // namespace lancer
