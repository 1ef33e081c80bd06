#include "reference/material_list.h"

#include <fnmatch.h>

#include <stdexcept>

#include "reference/principled.h"
#include "scene/build/shapes.h"
#include "scene/description/presets.h"

namespace reference {

using lancer::MaterialDescription;
using lancer::MaterialType;

bool Material::bounds_medium() const
{
    return (what.type == MaterialType::glass && !what.thin.value_or(false)) ||
           (what.type == MaterialType::interface && what.phong.refraction > 0);
}
double Material::medium_index() const
{
    if (what.type == MaterialType::glass) return double{what.ior};
    return double{what.phong.inside_ior} / (what.priority ? 1 : double{what.phong.outside_ior});
}

bool Material::is_bare() const
{
    const auto none = [](const lancer::Color& c) { return c == lancer::Color{}; };
    const bool fills = what.priority || what.subsurface_color || !none(what.absorption) || !none(what.scattering);
    return fills && bounds_medium() && what.type == MaterialType::glass && what.ior == 1 && !base &&
           what.base_color == lancer::Color{1, 1, 1} && none(what.emission);
}

const Texture* MaterialList::texture(const lancer::TextureUse& use)
{
    if (!use) return nullptr;
    world_.textures.push_back(std::make_unique<Texture>(*use, images_));
    return world_.textures.back().get();
}

size_t MaterialList::add(const MaterialDescription& said)
{
    const MaterialDescription m = lancer::plainest(said);
    Material material;
    material.what = m;
    material.opacity = texture(m.opacity_map);
    material.bump = texture(m.bump_map);
    material.normals = texture(m.normal_map);
    material.emission = texture(m.emission_map);
    const bool is_metal = m.type == MaterialType::metal, is_plastic = m.type == MaterialType::plastic;
    const float usual = is_metal ? 1 : 0;
    if ((is_metal || is_plastic) && (m.metallic.value_or(usual) != usual || m.metallic_map)) {
        // A part of it is metal: a mix of the two, which have nothing but their way of scattering.
        MaterialDescription part = m;
        part.metallic.reset(), part.metallic_map.reset();
        part.type = MaterialType::plastic;
        material.first = add(part);
        part.type = MaterialType::metal;
        material.second = add(part);
        material.what.type = MaterialType::mix;
        material.what.weight = m.metallic.value_or(usual);
        material.weight = texture(m.metallic_map);
    } else if (m.type == MaterialType::mix) {
        material.first = named(m.first), material.second = named(m.second);
        material.weight = texture(m.weight_map);
    } else {
        material.base = texture(m.base_color_map);
        material.transmittance = texture(m.transmittance_map);
        material.roughness = texture(m.roughness_map);
        if (material.roughness && d_.render.multiscatter)
            throw std::invalid_argument("the reference knows no textured roughness with multiscatter");
        const bool is_diffuse = m.type == MaterialType::lambert || m.type == MaterialType::translucent;
        material.mirrors =
            m.type == MaterialType::interface ? m.phong.reflexion > 0 || m.phong.refraction > 0 : !is_diffuse;
        if (is_metal && m.eta && m.k) {
            Bsdf smooth;
            smooth.kind = Bsdf::Kind::metal, smooth.color = grey(1);
            smooth.conductor = {rgb(*m.eta), rgb(*m.k)};
            material.mean_of_conductor = under_even_light([&](double cos) { return smooth.facet_reflectance(cos); });
        }
        if (m.type == MaterialType::principled) {
            if (material.roughness) throw std::invalid_argument("the reference knows no textured roughness");
            material.principled = std::make_shared<PrincipledModel>(m);
        }
        if (is_plastic) {
            if (material.roughness) throw std::invalid_argument("the reference knows no textured roughness of plastic");
            const auto roughness = double{m.roughness};
            material.coat = std::make_shared<CoatAlbedo>(double{m.ior}, roughness * roughness);
        }
    }
    if (material.is_mix())
        material.mirrors = world_.materials[material.first].mirrors || world_.materials[material.second].mirrors;
    world_.materials.push_back(std::move(material));
    return world_.materials.size() - 1;
}

MaterialDescription MaterialList::described(const std::string& name) const
{
    for (const MaterialDescription& m : d_.materials)
        if (m.name == name && !name.empty()) return m;
    if (const auto preset = lancer::find_preset(name)) return *preset;
    if (!name.empty()) throw std::invalid_argument("no material " + name);
    return {};
}

size_t MaterialList::named(const std::string& name)
{
    const auto known = named_.find(name);
    if (known != named_.end()) return known->second;
    const size_t id = add(described(name));
    named_[name] = id;
    return id;
}

size_t MaterialList::of_file(const MaterialDescription& m)
{
    for (const lancer::MaterialOverride& o : d_.overrides)
        if (fnmatch(o.match.c_str(), m.name.c_str(), 0) == 0)
            return o.material.empty() ? add(o.change(m)) : named(o.material);
    return add(m);
}

size_t MaterialList::inside_out(const std::string& name)
{
    MaterialDescription m = described(name);
    m.ior = 1 / m.ior;
    std::swap(m.phong.inside_ior, m.phong.outside_ior);
    return add(m);
}

size_t MaterialList::banded(const std::string& name, const lancer::Bands& bands, lancer::TextureType pattern)
{
    MaterialDescription mix;
    mix.type = MaterialType::mix;
    mix.first = name;
    mix.second = bands.material;
    mix.weight = 1;
    mix.weight_map.emplace();
    mix.weight_map->type = pattern;
    mix.weight_map->band_width = bands.width;
    return add(mix);
}

size_t MaterialList::water(const lancer::PlaneDescription& plane)
{
    MaterialDescription m = described(plane.material);
    if (plane.material.empty()) {
        m.type = MaterialType::glass;
        m.base_color = {1, 1, 1};
        m.ior = 1.33f;
    }
    m.bump_map.emplace();
    m.bump_map->type = lancer::TextureType::waves;
    m.bump_map->waves = plane.waves.empty() ? lancer::default_waves(false) : plane.waves;
    return add(m);
}

}  // namespace reference
