// The BSDF of a principled material (materials/principled.h) at one point. Its lobes are sampled by what they send of
// light from wo; eval() has the density of all of them together.
#pragma once

#include "materials/anisotropic.h"
#include "materials/anisotropic_table.h"
#include "materials/bsdf.h"
#include "materials/glass.h"

namespace lancer {

struct Principled;

struct PrincipledBsdf {
    const Principled* material = nullptr;
    Color base{}, transmittance{}, fuzz_color{};
    float roughness = 0, anisotropy = 0;  // of the base
    AlphaPair alpha{};                    // likewise
    Vec2 turn{1, 0};                      // the tangent in local directions: cosine and sine
    float metallic = 0, transmission = 0;
    float coat = 0, coat_alpha = 0;
    float fuzz = 0, fuzz_roughness = 0;
    float film = 0, film_thickness = 0;
    float media_eta = 0;  // as in ShadingPoint
    bool front = true;
    bool has_smooth = false, sends_through = false;  // lobes that are not delta, and such behind the surface

    // Sets the last two from all others.
    void finish();
    bool only_delta() const { return !has_smooth; }
    bool transmits() const { return sends_through; }
    // Index beyond the surface over index before it, of what goes through; 1 if nothing is turned.
    float index_beyond() const;
    Color reflectance() const;
    BsdfValue eval(Vec3 wo, Vec3 wi) const;
    Color eval_diffuse(Vec3 wo, Vec3 wi) const;
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const;

    // The same with what depends on wo alone computed once. wo.z > 0.
    struct Lobes;
    Lobes seen_from(Vec3 wo) const;
    BsdfValue eval(const Lobes& lobes, Vec3 wi) const;
    std::optional<BsdfSample> sample(const Lobes& lobes, float u, Vec2 v) const;

private:
    void add_coat(Lobes& lobes) const;
    void add_base(Lobes& lobes) const;
    void choose(Lobes& lobes) const;
    BsdfValue eval_lobes(const Lobes& lobes, Vec3 wi) const;
    Color diffuse(const Lobes& lobes, Vec3 wi) const;
    Color metal_reflectance(float cos) const;
    Color dielectric_reflectance(float cos) const;
    Color dielectric_albedo(float cos, float lost) const;
    Color film_on_glass(const GlassBsdf& g, double cos, bool through) const;
    Color film_on_boundary(const GlassBsdf& g, const Fresnel& bare, double cos) const;
    GlassBsdf glass() const;
    void add_glass(const Lobes& lobes, Vec3 wi, BsdfValue& f) const;
    std::optional<Vec3> sample_base(const Lobes& lobes, Vec2 v) const;
    Vec3d to_tangent(Vec3d w) const;
    float part_of_body() const { return (1 - metallic) * (1 - transmission); }
    float part_of_glass() const { return (1 - metallic) * transmission; }
};
static_assert(Bsdf<PrincipledBsdf>);

struct PrincipledBsdf::Lobes {
    Vec3 wo;
    Vec3d o, along;                 // unit; along: in the frame of the tangent, where facets are anisotropic
    float fuzz_scale = 0;           // of Fuzz::eval(), with the part that is covered
    float under_fuzz = 1;           // factor of all below
    Color under_coat{1, 1, 1};      // likewise; with that of the fuzz
    Color through{1, 1, 1};         // of the dielectric's reflection: 1 - E
    float mean_through = 1;         // its mean
    float lost = 0, mean_lost = 0;  // of the metal's facets
    Color further{};                // the light of multiple scattering over that lost
    AlbedoTable::Row coat_row{}, dielectric_row{}, metal_row{};
    AnisotropicTable::At wide_dielectric{}, wide_metal{};
    float diffuse_chance = 0, coat_chance = 0, facet_chance = 0, glass_chance = 0;
};

}  // namespace lancer
