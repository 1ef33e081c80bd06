// How surfaces scatter, in double and written from the papers and docs/integrators.md; directions are local, z the
// shading normal on the side of wo.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "reference/multiple.h"
#include "reference/random.h"
#include "reference/vector.h"

namespace reference {

// Isotropic GGX. Walter, Marschner, Li, Torrance, "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007,
// equations 33 and 34; Heitz, "Understanding the Masking-Shadowing Function", JCGT 3(2), 2014.
struct Facets {
    double alpha;

    double density(Vec m) const;  // of normals, m unit, z > 0
    double lambda(Vec w) const;
    double both_seen(Vec a, Vec b) const { return 1 / (1 + lambda(a) + lambda(b)); }  // G2, height-correlated
    // A normal as w sees them: Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018.
    Vec seen_from(Vec w, double u, double v) const;
};

// What a dielectric coat of GGX facets reflects, by quadrature over the facets that are seen: by the angle, and its
// mean under even light.
class CoatAlbedo {
public:
    CoatAlbedo(double index, double alpha);
    double at(double cos) const;
    double mean() const { return mean_; }

private:
    static constexpr int steps = 128;
    std::array<double, steps + 1> albedo_{};  // at the cosines (i / steps)^2
    double mean_ = 0, index_, alpha_;
};

class PrincipledModel;

struct Scattered {
    Vec wi;
    Rgb weight;  // f |cos| over the density
    bool delta = false;
    double index = 1;  // of what goes through: beyond over before
};

// What a place scatters with; which members count depends on the kind.
struct Bsdf {
    enum class Kind { lambert, translucent, mirror, metal, glass, sheet, plastic, interface, principled };
    Kind kind = Kind::lambert;
    Rgb color{};       // albedo, tint, F0
    double alpha = 0;  // 0: smooth
    double index = 1;  // glass, interface: beyond the surface over before it; plastic: of the coat; sheet: of its glass
    std::optional<std::array<Rgb, 2>> conductor{};  // metal: eta and k
    Rgb coat{};                                     // plastic: tint of what the coat reflects
    const CoatAlbedo* coat_albedo = nullptr;        // plastic
    Rgb diffuse{}, gloss{}, mirror{}, through{};    // interface; translucent: diffuse and through
    double shininess = 0;
    bool refracts = false;
    const PrincipledModel* principled = nullptr;
    EvenLobes even{};  // metal, glass, sheet: of multiple scattering

    bool only_delta() const;
    Rgb eval(Vec wo, Vec wi) const;  // f |cos(wi)|, without what is sharp
    std::optional<Scattered> sample(Vec wo, Random& random) const;
    Rgb facet_reflectance(double cos) const;  // of what reflects by facets, at a facet

private:
    Rgb eval_once(Vec wo, Vec wi) const;
    std::optional<Scattered> sample_once(Vec wo, Random& random) const;
    std::optional<Scattered> sample_even(Vec wo, Random& random) const;
    Rgb eval_glass(Vec wo, Vec wi) const;
    std::optional<Scattered> sample_facets(Vec wo, Random& random) const;
    std::optional<Scattered> sample_glass(Vec wo, Random& random) const;
    Rgb eval_sheet(Vec wo, Vec wi) const;
    std::optional<Scattered> sample_sheet(Vec wo, Random& random) const;
    std::optional<Scattered> sample_plastic(Vec wo, Random& random) const;
    std::optional<Scattered> sample_principled(Vec wo, Random& random) const;
    std::optional<Scattered> sample_interface(Vec wo, Random& random) const;
};

}  // namespace reference
