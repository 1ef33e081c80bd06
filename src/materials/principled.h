// The material of many layers that programs exchange: the subset of OpenPBR Surface 1.1 that files use. From above:
//   fuzz on a clear coat on a base; the base is metal, or a dielectric over a diffuse body or over what is inside.
// Portsmouth, Hill, Kutz et al., "OpenPBR: Novel Features and Implementation Details", SIGGRAPH 2025 courses, and the
// specification of OpenPBR. Coat and fuzz let through what their albedo leaves, as seen from wo: all light of a white
// furnace stays, whatever is below; but light may not travel both ways alike under them (docs/integrators.md).
// Without them, a film on a diffuse body, or a rough diffuse body it may.
#pragma once

#include <memory>

#include "materials/anisotropic_table.h"
#include "materials/film_losses.h"
#include "materials/fuzz.h"
#include "materials/glass.h"
#include "materials/material_type.h"
#include "materials/parameter.h"
#include "materials/phong.h"
#include "materials/plastic_coat.h"
#include "materials/principled_bsdf.h"

namespace lancer {

// What is computed once of a principled material. A table that no point of it asks is missing.
struct PrincipledTables {
    Glass glass{};                                    // what is let through; its tint and roughness do not count
    float dielectric_ior = 1.5f;                      // of the base: that of its reflection
    float mean_through = 1, coat_mean_through = 1;    // mean_transmittance() of smooth ones
    std::shared_ptr<const AlbedoTable> dielectric{};  // of dielectric_ior
    std::shared_ptr<const AlbedoTable> coat{};        // of the coat's index
    std::shared_ptr<const AlbedoTable> metal{};       // of reflectors; missing: multiple scattering is lost
    std::shared_ptr<const AnisotropicTable> wide_dielectric{}, wide_metal{};  // the same where facets are anisotropic
    std::shared_ptr<const FilmTable> film{};                                  // of a rough dielectric
    std::shared_ptr<const FilmLosses> film_losses{};                          // of rough glass, likewise
    std::shared_ptr<const FuzzTable> fuzz{};
};

struct Principled {
    static constexpr MaterialType type = MaterialType::principled;
    ColorParam base;                            // albedo of the diffuse body, F0 of the metal
    float diffuse_roughness = 0;                // in [0, 1]
    FloatParam metallic = 0;                    // part that is metal
    float specular_weight = 1;                  // of the reflection of the base
    Color specular{1, 1, 1};                    // tint of the dielectric's reflection, and of the metal's near the edge
    float ior = 1.5f;                           // of the dielectric
    FloatParam roughness = 0.3f;                // of the base, perceptual
    FloatParam anisotropy = 0, rotation = 0;    // rotation: of the tangent, part of a turn
    FloatParam transmission = 0;                // part of the dielectric without a diffuse body
    ColorParam transmittance{Color{1, 1, 1}};   // tint of each refraction
    FloatParam coat = 0, coat_roughness = 0;    // coat: part that is coated
    Color coat_color{1, 1, 1};                  // what of light that enters and leaves straight is left
    float coat_ior = 1.6f, coat_darkening = 1;  // darkening: part of the light that the coat sends back in that counts
    FloatParam fuzz = 0, fuzz_roughness = 0.5f;  // fuzz: part that is covered
    ColorParam fuzz_color{Color{1, 1, 1}};
    FloatParam film = 0, film_thickness = 500;  // film: part that is covered; thickness in nanometres
    float film_ior = 1.4f;
    std::shared_ptr<const PrincipledTables> tables{};

    // Base weight and depth are factors of others; what absorbs, scatters and has a priority is the medium inside.
    static constexpr auto parameters =
        std::tuple{parameter("base_color", &Principled::base),
                   parameter("base_weight"),
                   parameter("diffuse_roughness", &Principled::diffuse_roughness),
                   parameter("metallic", &Principled::metallic, 0.0f),
                   parameter("specular_weight", &Principled::specular_weight),
                   parameter("specular", &Principled::specular),
                   parameter("ior", &Principled::ior),
                   parameter("roughness", &Principled::roughness, 0.3f),
                   parameter("anisotropy", &Principled::anisotropy),
                   parameter("anisotropy_rotation", &Principled::rotation),
                   parameter("transmission", &Principled::transmission),
                   parameter("transmittance", &Principled::transmittance, Color{1, 1, 1}),
                   parameter("transmission_depth"),
                   parameter("thin"),
                   parameter("absorption"),
                   parameter("priority"),
                   parameter("scattering"),
                   parameter("scattering_anisotropy"),
                   parameter("subsurface_color"),
                   parameter("subsurface_radius"),
                   parameter("coat", &Principled::coat),
                   parameter("coat_color", &Principled::coat_color),
                   parameter("coat_roughness", &Principled::coat_roughness),
                   parameter("coat_ior", &Principled::coat_ior),
                   parameter("coat_darkening", &Principled::coat_darkening),
                   parameter("fuzz", &Principled::fuzz),
                   parameter("fuzz_color", &Principled::fuzz_color),
                   parameter("fuzz_roughness", &Principled::fuzz_roughness),
                   parameter("film", &Principled::film),
                   parameter("film_thickness", &Principled::film_thickness),
                   parameter("film_ior", &Principled::film_ior)};

    PrincipledBsdf at(const ShadingPoint& p) const;
    static constexpr bool mirrors() { return true; }
    // Whether its facets have a direction, for which a point needs a tangent.
    bool is_anisotropic() const
    {
        const bool under_rough_coat = coat.value > 0 && alpha_of_roughness(coat_roughness.value) > 0;
        return anisotropy.value > 0 && (under_rough_coat || alpha_of_roughness(roughness.value) > 0);
    }
    bool is_thin() const { return tables && tables->glass.thin; }
    std::optional<float> medium_ior(bool) const
    {
        return transmission.value > 0 && !is_thin() ? std::optional(ior) : std::nullopt;
    }
    Phong phong(const ShadingPoint& p) const;
};

// The roughness of a base under a coat, which spreads what it lets through twice (OpenPBR, "coat roughening").
inline float roughness_under_coat(float roughness, float coat, float coat_roughness)
{
    if (!(coat > 0) || !(coat_roughness > 0)) return roughness;
    const auto fourth = [](float x) { return x * x * x * x; };
    const float rough = std::min(1.0f, fourth(roughness) + 2 * fourth(coat_roughness));
    return mix(roughness, std::sqrt(std::sqrt(rough)), std::min(1.0f, coat));
}

// The index whose reflectance at normal incidence is `weight` times that of another: it scales the reflection, and
// leaves that at grazing angles. weight: in [0, 1].
inline float ior_of_weight(float ior, float weight)
{
    if (weight == 1) return ior;
    const float amplitude = (ior - 1) / (ior + 1) * std::sqrt(weight);
    return (1 + amplitude) / (1 - amplitude);
}

}  // namespace lancer
