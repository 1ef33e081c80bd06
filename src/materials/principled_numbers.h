// What a principled material (materials/principled.h) is at one point, or at four: numbers, and what it asks of tables.
#pragma once

#include "materials/albedo_table.h"
#include "materials/anisotropic_table.h"
#include "materials/film_table.h"
#include "materials/fuzz.h"
#include "materials/spectrum.h"

namespace lancer {

// What is the same for all directions. T: float or a vector of them.
template <class T>
struct PrincipledNumbers {
    SpectrumOf<T> base{}, fuzz_color{};
    T metallic{}, coat{}, coat_alpha{}, fuzz{};
    // The following by PrincipledBsdf::finish().
    SpectrumOf<T> specular{}, edge{};  // edge: what the tint takes from Schlick's reflectance, at its most
    SpectrumOf<T> further{};           // of the metal: the light of multiple scattering over that lost
    T body{};                          // part with a diffuse body
    T facet_alpha{}, specular_weight{}, dielectric_ior{};
    T mean_through{}, mean_lost{};      // of the dielectric's reflection: 1 - its mean; of the metal's facets
    T coat_ior{}, coat_even{}, blur{};  // for the coat's darkening: see there
    T coat_darkening{}, fuzz_scale{};   // with the part that is covered; fuzz_scale: of Fuzz::eval()
};

// What few points have, each with the values of all others: a coat with a colour, fuzz, a film, anisotropic facets, a
// rough body, something clear.
template <class T>
struct PrincipledTint {
    SpectrumOf<T> coat_color = each(SpectrumOf<T>{}, [](T x) { return x + 1.0f; });
};
template <class T>
struct PrincipledFuzz {
    T fuzz_roughness{};
};
template <class T>
struct PrincipledFilm {
    T film{}, film_thickness{}, film_ior = T{} + 1.0f, film_roughness{};  // film_roughness: of the base
};
template <class T>
struct PrincipledWide {
    T across{};                           // alpha across the tangent, along it facet_alpha; 0: the same
    T turn_cos = T{} + 1.0f, turn_sin{};  // the tangent in local directions
};
template <class T>
struct PrincipledRoughBody {
    T diffuse_roughness{};
};
template <class T>
struct PrincipledClear {
    T clear{};  // part of what goes through
    SpectrumOf<T> transmittance{};
};
template <class T>
struct PrincipledExtras : PrincipledTint<T>,
                          PrincipledFuzz<T>,
                          PrincipledFilm<T>,
                          PrincipledWide<T>,
                          PrincipledRoughBody<T>,
                          PrincipledClear<T> {
};
// Which of them there are, at any of the points.
struct PrincipledKinds {
    bool tint = false, fuzz = false, film = false, wide = false, rough_body = false, clear = false;
    bool any = false;  // of those

    void add(const PrincipledKinds& o)
    {
        tint |= o.tint, fuzz |= o.fuzz, film |= o.film, wide |= o.wide;
        rough_body |= o.rough_body, clear |= o.clear, any |= o.any;
    }
};
// The tables of those. A table that a point has not is missing.
template <class T>
struct PrincipledRows {
    RowsOf<T, FuzzTable::Row> fuzz_row{};
    RowsOf<T, AnisotropicTable::At> wide_dielectric{}, wide_metal{};
    RowsOf<T, const FilmTable*> film_table{};
};

}  // namespace lancer
