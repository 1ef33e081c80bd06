// The list of materials. A new one is a header and a word here; the laws in tests/materials pick it up unasked.
// A material is parameters; at a hit it becomes a BSDF, a small value with everything looked up. It may refer to its
// material, which must live as long.
#pragma once

#include <variant>

#include "materials/glass.h"
#include "materials/interface.h"
#include "materials/lambert.h"
#include "materials/medium.h"
#include "materials/metal.h"
#include "materials/mirror.h"
#include "materials/plastic.h"

namespace lancer {

using Material = std::variant<Lambert, Mirror, Metal, Glass, Plastic, Interface>;

// What any of them becomes.
template <class... M>
std::variant<decltype(std::declval<const M&>().at(std::declval<const ShadingPoint&>()))...> bsdf_of(
    const std::variant<M...>&);
using AnyBsdf = decltype(bsdf_of(std::declval<const Material&>()));

// Radiance that a surface sends out by itself.
struct Emission {
    ColorParam radiance;
    bool both_sides = false;  // else only from the side of the geometric normal

    bool is_dark() const { return is_black(radiance.value); }
    // Towards a point on the front or back side. Always of the texture's finest level: whether a light sample or a ray
    // found the place must not matter.
    Color towards(bool front, const ShadingPoint& p) const
    {
        if (radiance.texture == no_texture) return plain_towards(front);
        return front || both_sides ? p.finest().eval(radiance) : Color{};
    }
    // The same where there is no texture.
    Color plain_towards(bool front) const { return front || both_sides ? radiance.value : Color{}; }
};

// What of a material is not its BSDF: looked at where rays meet the surface, before anything scatters.
struct MaterialTraits {
    FloatParam opacity = 1;            // the part of the rays that the surface stops
    uint32_t bump = no_texture;        // heights
    uint32_t normal_map = no_texture;  // normals, tangent space, encoded in [0, 1]
    float bump_scale = 1;              // slope of a step from black to white between neighbouring texels
    uint16_t medium = no_medium;       // what is behind the surface, in Scene::media
    bool mirrors = false;              // it has a lobe around the mirror direction
    bool reads_uv = false;             // something of the material, its BSDF included, is looked up in a texture

    bool tilts() const { return bump != no_texture || normal_map != no_texture; }
    bool has_holes() const { return opacity.texture != no_texture || opacity.value < 1; }
};

// A material that is at each place one of two others, by chance: `second` with probability `weight`, so that the mean
// is their mix.
struct Mix {
    uint32_t first = 0, second = 0;  // ids of materials
    FloatParam weight;
};

}  // namespace lancer
