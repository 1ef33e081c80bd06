// What a material is besides its BSDF: what it emits, what is evaluated before it scatters, and mixes of two.
#pragma once

#include <cstdint>

#include "materials/material_type.h"
#include "materials/medium.h"
#include "materials/parameter.h"

namespace lancer {

// Emitted radiance of a surface.
struct Emission {
    ColorParam radiance;
    bool both_sides = false;  // false: only on the side of the geometric normal
    static constexpr auto parameters =
        std::tuple{parameter("emission", &Emission::radiance), parameter("emission_sides", &Emission::both_sides),
                   parameter("group")};  // in Scene::light_groups

    bool is_dark() const { return is_black(radiance.value); }
    // Radiance on the front or back side, from the texture's finest level, so that light sampling and BSDF sampling
    // agree.
    Color towards(bool front, const ShadingPoint& p) const
    {
        if (radiance.texture == no_texture) return plain_towards(front);
        return front || both_sides ? p.finest().eval(radiance) : Color{};
    }
    // The same without a texture.
    Color plain_towards(bool front) const { return front || both_sides ? radiance.value : Color{}; }
};

// Properties of a material besides its BSDF; they are evaluated before scattering.
struct MaterialTraits {
    FloatParam opacity = 1;            // probability that the surface stops a ray
    uint32_t bump = no_texture;        // heights
    uint32_t normal_map = no_texture;  // normals, tangent space, encoded in [0, 1]
    float bump_scale = 1;              // slope of a step from black to white between neighbouring texels
    bool catches_shadows = false;      // in pictures with alpha it is nothing but the shadows on it
    static constexpr auto parameters = std::tuple{
        parameter("opacity", &MaterialTraits::opacity), parameter("bump_texture", &MaterialTraits::bump),
        parameter("bump_scale", &MaterialTraits::bump_scale), parameter("normal_texture", &MaterialTraits::normal_map),
        parameter("shadow_catcher", &MaterialTraits::catches_shadows),
        // Of the shape, which is displaced before it is rendered.
        parameter("displacement_texture"), parameter("displacement_scale"), parameter("displacement_midlevel")};
    uint16_t medium = no_medium;   // medium behind the surface, index in Scene::media
    bool mirrors = false;          // it has a lobe around the mirror direction
    bool has_tangent = false;      // its facets have a direction: its points have a tangent
    bool reads_uv = false;         // some parameter, those of the BSDF included, has a texture, or it has a tangent
    bool reads_second_uv = false;  // some texture is looked up by the second set of texture coordinates
    bool tangents_by_second_uv = false;  // those of the normal map

    bool tilts() const { return bump != no_texture || normal_map != no_texture; }
    bool needs_tangents() const { return tilts() || has_tangent; }
    // Whether meshes keep tangents for it: see tangent_frame_at().
    bool reads_tangents() const { return normal_map != no_texture || has_tangent; }
    bool has_holes() const { return opacity.texture != no_texture || opacity.value < 1; }
};

// A mix: at each point randomly one of two materials, `second` with probability `weight`, so that the mean is their
// mix.
struct Mix {
    static constexpr MaterialType type = MaterialType::mix;
    uint32_t first = 0, second = 0;  // ids of materials
    FloatParam weight;
    static constexpr auto parameters =
        std::tuple{parameter("first"), parameter("second"), parameter("weight", &Mix::weight)};
};

}  // namespace lancer
