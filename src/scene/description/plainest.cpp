#include <algorithm>
#include <cmath>

#include "materials/principled.h"
#include "scene/description/material.h"

namespace lancer {
namespace {

constexpr Color no_tint{1, 1, 1};

bool is_never(float weight) { return weight == 0; }

// What absorbs on a depth instead of a tint at the surface, and the weight of the base colour.
void resolve_factors(MaterialDescription& m)
{
    m.base_color *= m.base_weight, m.base_weight = 1;
    if (!(m.transmission_depth > 0)) return;
    constexpr float darkest = 1e-6f;
    const auto absorbed = [&](float left) {
        return std::min(-std::log(std::clamp(left, darkest, 1.0f)) / m.transmission_depth, 1e30f);
    };
    const Color c = m.transmittance;
    m.absorption += Color{absorbed(c.r), absorbed(c.g), absorbed(c.b)};
    m.transmittance = no_tint, m.transmission_depth = 0;
}

bool has_layers(const MaterialDescription& m) { return !is_never(m.coat) || !is_never(m.fuzz) || !is_never(m.film); }

// As `to`, with what a plainer material of that type has.
MaterialDescription as(MaterialDescription m, MaterialType to)
{
    const MaterialDescription usual = default_description(MaterialType::lambert);
    m.type = to;
    for_each_material_parameter([&](const auto& row) {
        if (types_with(row.key).empty() || has_parameter(to, row.key)) return;
        row.value_of(m) = row.value_of(usual);
        if constexpr (has_map<decltype(row)>) row.map_of(m) = {};
    });
    return m;
}

}  // namespace

MaterialDescription plainest(const MaterialDescription& said)
{
    if (said.type != MaterialType::principled) return said;
    MaterialDescription m = said;
    resolve_factors(m);
    const float metallic = m.metallic.value_or(0.0f);
    const bool is_metal = metallic == 1 && !m.metallic_map, has_metal = metallic > 0;
    const bool is_clear = m.transmission == 1 && !m.transmission_map, has_clear = m.transmission > 0;
    if (has_layers(m) || m.anisotropy > 0) return m;
    if (is_metal) {
        if (m.specular != no_tint || m.specular_weight != 1) return m;
        const bool is_white = m.base_color == no_tint && !m.base_color_map;
        const bool is_smooth = alpha_of_roughness(m.roughness) == 0;
        return as(m, is_white && is_smooth ? MaterialType::mirror : MaterialType::metal);
    }
    if (is_clear && !has_metal) {
        const bool is_tinted = m.specular != no_tint || m.transmittance != no_tint || m.transmittance_map;
        if (is_tinted || m.specular_weight != 1) return m;
        m.base_color = no_tint, m.base_color_map.reset();
        return as(m, MaterialType::glass);
    }
    if (has_clear || m.diffuse_roughness > 0) return m;
    if (!has_metal && m.specular_weight == 0) return as(m, MaterialType::lambert);
    if (has_metal && (m.specular != no_tint || m.specular_weight != 1)) return m;
    m.ior = ior_of_weight(m.ior, m.specular_weight);
    return as(m, MaterialType::plastic);
}

}  // namespace lancer
