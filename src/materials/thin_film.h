// Reflectance of a dielectric film on a boundary: the series of all orders of reflection between the two faces of the
// film, for both polarisations. Interference depends on the wavelength; each of the three channels sees a band of the
// spectrum, taken for a Gaussian in the wave number, whose mean of the series has a closed form. So fringes fade as a
// film grows thick, as they do for eyes, where three single wavelengths would shine in saturated colours. The method is
// that of Belcour and Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", ACM
// TOG 36(4), 2017; the bands are those of the primaries of sRGB: light that is white before stays white where nothing
// interferes, which matching functions with negative parts would not promise. Phases are those of boundaries without
// absorption: 0 or half a turn.
#pragma once

#include "materials/spectrum.h"

namespace lancer {

// T: float or Float4.
template <class T>
struct ThinFilmT {
    using Spectrum = SpectrumOf<T>;

    T ior;        // of the film, over that outside
    T thickness;  // nanometres

    // Reflectance at an angle outside, in [0, 1], on a dielectric. base_ior: of that, over that outside.
    Spectrum on_dielectric(T cos, T base_ior) const;
    // On a metal that reflects this part at this angle, the same of both polarisations.
    Spectrum on_metal(T cos, const Spectrum& base) const;

private:
    template <class F>
    Spectrum reflectance(T cos, const F& below) const;
};
using ThinFilm = ThinFilmT<float>;

}  // namespace lancer
