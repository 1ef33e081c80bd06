#include "scene/build/material_table.h"

#include <algorithm>
#include <cmath>

#include "core/names.h"
#include "scene/build/fill_parameters.h"
#include "scene/build/light_group.h"
#include "scene/build/media.h"
#include "scene/build/overrides.h"
#include "scene/description/presets.h"

namespace lancer {
namespace {

void check_indices(const MaterialDescription& m, Diagnostics& diagnostics)
{
    const float eta = m.phong.inside_ior / m.phong.outside_ior;
    if (eta > 0 && std::isfinite(eta)) return;
    diagnostics.error(m.where, "the indices of refraction of material " + in_quotes(m.name) +
                                   " are too far apart: their ratio is no number of 32 bits");
}

// A translucent sheet is scaled where its two colours exceed 1 (materials/translucent.h). Textures may dim them, so
// that only numbers without one are known to do so.
void warn_of_gain(const MaterialDescription& m, Diagnostics& diagnostics)
{
    if (m.base_color_map || m.transmittance_map) return;
    if (max_component(m.base_color + m.transmittance) <= 1 + gamma(2)) return;
    diagnostics.warning(m.where, NamedProblem{"the 'base_color' and 'transmittance' of", m.name,
                                              " add up to more than 1 in some channel; both are divided by the "
                                              "largest sum"});
}

// A texture that is not an image.
Texture make_formula(const TextureDescription& t, bool legacy)
{
    const Vec2 scale = t.use.scale, offset = t.use.offset;
    switch (t.type) {
        case TextureType::waves:
            return Waves(t.waves, scale, offset, legacy);
        case TextureType::rim:
            return Rim{t.band_width, legacy};
        case TextureType::grid:
            return Grid{t.band, t.ground, t.band_width, scale, offset, legacy};
        case TextureType::checker:
            return Checker{.even = t.even, .odd = t.odd, .scale = scale, .offset = offset};
        case TextureType::image:
            break;
    }
    return Checker{.even = {1, 1, 1}, .odd = {1, 1, 1}};
}

}  // namespace

MaterialTable::MaterialTable(const SceneDescription& description, const RenderSettings& settings, Scene& scene,
                             std::vector<PendingPictures::OfTexture>& pending, Diagnostics& diagnostics,
                             const RasterSource& images)
    : d_(description),
      scene_(scene),
      pending_(pending),
      diagnostics_(diagnostics),
      images_(images),
      integrator_(settings.integrator),
      builder_({.multiscatter = settings.multiscatter && !settings.legacy, .fresnel = settings.fresnel}),
      ids_(description.materials.size(), Scene::none),
      used_(description.materials.size()),
      in_progress_(description.materials.size()),
      override_used_(description.overrides.size())
{
    for (size_t i = 0; i < d_.materials.size(); ++i) index_.emplace(d_.materials[i].name, i);
}

// Created on first use; unused materials are not loaded. Mixes name other materials in any order; a mix that contains
// itself is an error.
void MaterialTable::resolve_named(size_t index)
{
    if (ids_[index] != Scene::none) return;
    const MaterialDescription& m = d_.materials[index];
    if (in_progress_[index]) {
        diagnostics_.error(m.where, "the mix " + in_quotes(m.name) + " contains itself");
        ids_[index] = default_material();
        return;
    }
    in_progress_[index] = true;
    const uint32_t id = add(m);
    if (ids_[index] == Scene::none) ids_[index] = id;
}

uint32_t MaterialTable::texture(const TextureUse& use)
{
    if (!use) return no_texture;
    if (const auto it = std::find(textures_.begin(), textures_.end(), *use); it != textures_.end()) {
        scene_.unused_features.add("duplicate textures", 1);
        return static_cast<uint32_t>(it - textures_.begin());
    }
    const auto id = static_cast<uint32_t>(textures_.size());
    textures_.push_back(*use);
    if (use->type != TextureType::image) {
        scene_.textures.push_back(make_formula(*use, scene_.legacy));
        return id;
    }
    scene_.textures.emplace_back(Checker{.even = {1, 1, 1}, .odd = {1, 1, 1}});
    pending_.push_back({id, *use, images_ ? images_(use->file) : RasterFuture{}});
    return id;
}

uint32_t MaterialTable::add_plain(const MaterialDescription& m, const Material& bsdf)
{
    const auto id_of = [&](const TextureUse& use) { return texture(use); };
    scene_.materials.push_back(bsdf);
    Emission emission;
    fill_parameters(emission, m, [&](const TextureUse& use) { return is_black(m.emission) ? no_texture : id_of(use); });
    scene_.emission.push_back(emission);
    MaterialTraits traits;
    fill_parameters(traits, m, id_of);
    traits.mirrors = std::visit([](const auto& b) { return b.mirrors(); }, bsdf);
    if (const auto* principled = std::get_if<Principled>(&bsdf)) traits.has_tangent = principled->is_anisotropic();
    traits.reads_uv = traits.has_tangent;
    for (const TextureUse* use : shading_textures_of(m)) {
        traits.reads_uv = traits.reads_uv || *use;
        traits.reads_second_uv = traits.reads_second_uv || (*use && (*use)->use.by_second_uv);
    }
    traits.tangents_by_second_uv = m.normal_map && m.normal_map->use.by_second_uv;
    traits.medium = add_medium(m, bsdf, integrator_, scene_, diagnostics_);
    scene_.traits.push_back(traits);
    scene_.material_names.push_back(m.name);
    scene_.light_groups.of_material.push_back(light_group(scene_, m.group, m.where, diagnostics_));
    if (!scene_.mix_of.empty()) scene_.mix_of.push_back(Scene::none);
    return static_cast<uint32_t>(scene_.materials.size() - 1);
}

// A mix has its own emission, opacity and bumps; its parts only scatter.
uint32_t MaterialTable::add_mix(const MaterialDescription& m, uint32_t first, uint32_t second, FloatParam weight)
{
    const uint32_t id = add_plain(m, Lambert{});
    MaterialTraits& traits = scene_.traits[id];
    for (const uint32_t part : {first, second}) {
        traits.reads_uv = traits.reads_uv || scene_.traits[part].reads_uv;
        traits.reads_second_uv = traits.reads_second_uv || scene_.traits[part].reads_second_uv;
        traits.mirrors = traits.mirrors || scene_.traits[part].mirrors;
        traits.has_tangent = traits.has_tangent || scene_.traits[part].has_tangent;
        if (const uint16_t medium = scene_.traits[part].medium; medium != no_medium && matters(scene_.media[medium]))
            diagnostics_.error(m.where, "material " + in_quotes(scene_.material_names[part]) +
                                            " has a 'priority', absorbs or scatters, and cannot be a part of the mix " +
                                            in_quotes(m.name) + ": a body has one inside");
    }
    scene_.mix_of.resize(scene_.materials.size(), Scene::none);
    scene_.mix_of[id] = static_cast<uint32_t>(scene_.mixes.size());
    scene_.mixes.push_back({first, second, weight});
    return id;
}

uint32_t MaterialTable::add(const MaterialDescription& said)
{
    const MaterialDescription m = plainest(said);
    // Meshes that share a material file bring the same materials repeatedly.
    for (const auto& [known, id] : added_[m.name]) {
        if (!(known == m)) continue;
        scene_.unused_features.add("duplicate materials", 1,
                                   sizeof(Material) + sizeof(Emission) + sizeof(MaterialTraits));
        return id;
    }
    const uint32_t id = make(m);
    added_[m.name].emplace_back(m, id);
    if (m.type == MaterialType::glass && !m.thin && !m.priority && !has_inside(m)) shape_decides_[id] = m;
    return id;
}

uint32_t MaterialTable::thin_version(uint32_t id)
{
    const auto [entry, is_new] = thin_.try_emplace(id);
    if (is_new) {
        MaterialDescription m = shape_decides_.at(id);
        m.thin = true;
        entry->second = add(m);
    }
    return entry->second;
}

uint32_t MaterialTable::make(const MaterialDescription& m)
{
    const auto id_of = [&](const TextureUse& use) { return texture(use); };
    if (m.type == MaterialType::mix)
        return add_mix(m, named(m.first, m.where), named(m.second, m.where), {m.weight, texture(m.weight_map)});
    if (m.type == MaterialType::interface) check_indices(m, diagnostics_);
    if (m.type == MaterialType::translucent) warn_of_gain(m, diagnostics_);
    const std::optional<float> usual = default_description(m.type).metallic;
    const float metallic = m.metallic.value_or(usual.value_or(0));
    if (!usual || m.type == MaterialType::principled || (metallic == *usual && !m.metallic_map))
        return add_plain(m, builder_.make(m, id_of));
    MaterialDescription part = m;
    part.emission = {};
    for (TextureUse* use : {&part.emission_map, &part.bump_map, &part.normal_map, &part.opacity_map}) use->reset();
    part.type = MaterialType::plastic;
    const uint32_t plastic = add_plain(part, builder_.make(part, id_of));
    part.type = MaterialType::metal;
    const uint32_t metal = add_plain(part, builder_.make(part, id_of));
    return add_mix(m, plastic, metal, {metallic, texture(m.metallic_map)});
}

uint32_t MaterialTable::add_from_file(const MaterialDescription& m)
{
    const MaterialOverride* const o = find_override(d_, m.name);
    if (!o) return add(m);
    override_used_[static_cast<size_t>(o - d_.overrides.data())] = true;
    return o->material.empty() ? add(o->change(m)) : named(o->material, o->where);
}

uint32_t MaterialTable::default_material()
{
    if (default_material_ == Scene::none) default_material_ = add({.name = "default", .where = {}});
    return default_material_;
}

uint32_t MaterialTable::named(const std::string& name, const Location& where)
{
    if (name.empty()) return default_material();
    if (const auto it = index_.find(name); it != index_.end()) {
        used_[it->second] = true;
        resolve_named(it->second);
        return ids_[it->second];
    }
    if (const auto it = presets_.find(name); it != presets_.end()) return it->second;
    if (const auto preset = find_preset(name)) return presets_[name] = add(*preset);
    diagnostics_.error(where, "unknown material '" + name + "'" + suggestion(name, names_of_materials(d_)));
    return default_material();
}

void MaterialTable::put_camera_into(const std::string& name, const Location& where)
{
    const uint16_t medium = scene_.traits[named(name, where)].medium;
    if (medium != no_medium)
        scene_.camera_media.enter(scene_.media, medium);
    else if (index_.count(name))
        diagnostics_.error(where, "the camera cannot be inside of " + in_quotes(name) + ", which fills nothing");
}

uint32_t MaterialTable::changed(const std::string& name, const Location& where, const std::string& how,
                                const MaterialDescription& otherwise,
                                const std::function<MaterialDescription(const MaterialDescription&)>& change)
{
    const auto it = index_.find(name);
    const auto preset = it == index_.end() ? find_preset(name) : std::nullopt;
    if (!name.empty() && it == index_.end() && !preset) return named(name, where);
    if (it != index_.end()) used_[it->second] = true;
    const auto [entry, is_new] = changed_.try_emplace({name, how}, Scene::none);
    if (is_new) entry->second = add(change(name.empty() ? otherwise : preset ? *preset : d_.materials[it->second]));
    return entry->second;
}

uint32_t MaterialTable::banded(const std::string& name, const Bands& bands, TextureType pattern, const Location& where)
{
    MaterialDescription mix;
    mix.name = (name.empty() ? "default" : name) + " with bands of " + bands.material;
    mix.where = where;
    mix.type = MaterialType::mix;
    mix.first = name;
    mix.second = bands.material;
    mix.weight = 1;
    mix.weight_map.emplace();
    mix.weight_map->where = where;
    mix.weight_map->type = pattern;
    mix.weight_map->band_width = bands.width;
    return add(mix);
}

void MaterialTable::finish()
{
    if (d_.camera && !d_.camera->inside.empty()) put_camera_into(d_.camera->inside, d_.camera->where);
    finish_media(scene_, diagnostics_);
    builder_.touch(scene_.media);
    for (size_t i = 0; i < d_.materials.size(); ++i)
        if (!used_[i]) {
            scene_.unused_features.add("unused materials", 1);
            diagnostics_.warning(d_.materials[i].where, NamedProblem{"material", d_.materials[i].name, " is not used"});
        }
    for (size_t i = 0; i < d_.overrides.size(); ++i)
        if (!override_used_[i])
            diagnostics_.warning(d_.overrides[i].where,
                                 NamedProblem{"no material of a mesh file matches", d_.overrides[i].match, ""});
}

}  // namespace lancer
