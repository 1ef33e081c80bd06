// The BSDF of a principled material (materials/principled.h) at one point. Its lobes are sampled by what they send of
// light from wo; eval() has the density of all of them together.
#pragma once

#include "materials/bsdf.h"
#include "materials/film_losses.h"
#include "materials/glass.h"
#include "materials/principled_layers.h"

namespace lancer {

struct Principled;

struct PrincipledBsdf : PrincipledLayers<float> {
    const Principled* material = nullptr;
    float roughness = 0, anisotropy = 0;  // of the base
    AlphaPair alpha{};                    // likewise
    float transmission = 0;
    float media_eta = 0;  // as in ShadingPoint
    bool front = true;
    // The following by finish().
    bool has_smooth = false, sends_through = false;  // lobes that are not delta, and such behind the surface
    bool is_queued = false;                          // PrincipledQueue has all that it is
    GlassBsdf glass{};                               // what is let through, but for its tint
    FilmLosses::At film_losses{};                    // of that under the film

    // Sets what follows from all others.
    void finish();
    // The tangent of the point turned by a part of a turn, about the front's normal: its cosine and sine.
    Vec2 turn_of(Vec2 tangent, float part) const;
    // At another point, where nothing but the tangent varies.
    Vec2 turn_of(Vec2 tangent) const;
    void turn(Vec2 cos_sin) { turn_cos = cos_sin.x, turn_sin = cos_sin.y; }
    bool only_delta() const { return !has_smooth; }
    bool transmits() const { return sends_through; }
    // Index beyond the surface over index before it, of what goes through; 1 if nothing is turned.
    float index_beyond() const;
    Color reflectance() const;
    BsdfValue eval(Vec3 wo, Vec3 wi) const;
    Color eval_diffuse(Vec3 wo, Vec3 wi) const;
    std::optional<BsdfSample> sample(Vec3 wo, float u, Vec2 v) const;

    // The same with what depends on wo alone computed once. wo.z > 0.
    Seen seen_from(Vec3 wo) const;
    BsdfValue eval(const Seen& lobes, Vec3 wi) const;
    std::optional<BsdfSample> sample(const Seen& lobes, float u, Vec2 v) const;

private:
    void finish_base();
    void finish_coat();
    void finish_extras();
    BsdfValue eval_lobes(const Seen& lobes, Vec3 wi) const;
    FilmLosses::At losses_of_film() const;
    Color film_on_glass(double cos, bool through) const;
    Color film_on_boundary(const Fresnel& bare, double cos) const;
    Color sheet_with_film(Vec3d o, Vec3d i, bool through) const;
    Color further_with_film(const Seen& lobes, Vec3 wi) const;
    void add_glass(const Seen& lobes, Vec3 wi, BsdfValue& f) const;
    std::optional<Vec3> sample_base(const Seen& lobes, Vec2 v) const;
};
static_assert(Bsdf<PrincipledBsdf>);

}  // namespace lancer
