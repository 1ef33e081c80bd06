#include "scene/material_table.h"

#include <fnmatch.h>

#include <algorithm>

#include "core/names.h"

namespace lancer {

MaterialTable::MaterialTable(const SceneDescription& description, Scene& scene, Diagnostics& diagnostics,
                             const RasterSource& images)
    : d_(description),
      scene_(scene),
      diagnostics_(diagnostics),
      images_(images),
      builder_({.multiscatter = description.render.is_on(Switch::multiscatter),
                .fresnel = description.render.is_on(Switch::fresnel)}),
      ids_(description.materials.size(), Scene::none),
      used_(description.materials.size()),
      in_progress_(description.materials.size()),
      override_used_(description.overrides.size())
{
    for (size_t i = 0; i < d_.materials.size(); ++i) index_.emplace(d_.materials[i].name, i);
}

// On first use: what nobody uses is not loaded. Mixes name other materials, in any order; one that contains itself is
// an error.
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
    const auto same = [&](const TextureDescription& t) {
        return t.type == use->type && t.file == use->file && t.use == use->use && t.even == use->even &&
               t.odd == use->odd;
    };
    if (const auto it = std::find_if(textures_.begin(), textures_.end(), same); it != textures_.end())
        return static_cast<uint32_t>(it - textures_.begin());
    const auto id = static_cast<uint32_t>(textures_.size());
    textures_.push_back(*use);
    if (use->type == TextureType::checker) {
        scene_.textures.emplace_back(
            Checker{.even = use->even, .odd = use->odd, .scale = use->use.scale, .offset = use->use.offset});
        return id;
    }
    scene_.textures.emplace_back(Checker{.even = {1, 1, 1}, .odd = {1, 1, 1}});
    scene_.pending.push_back({id, *use, images_ ? images_(use->file) : RasterFuture{}});
    return id;
}

uint32_t MaterialTable::add_plain(const MaterialDescription& m, const Material& bsdf)
{
    scene_.materials.push_back(bsdf);
    scene_.emission.push_back(
        {{m.emission, is_black(m.emission) ? no_texture : texture(m.emission_map)}, m.emission_both_sides});
    MaterialTraits traits;
    traits.opacity = {m.opacity, texture(m.opacity_map)};
    traits.bump = texture(m.bump_map);
    traits.normal_map = texture(m.normal_map);
    traits.bump_scale = m.bump_scale;
    traits.mirrors = m.type != MaterialType::lambert && m.type != MaterialType::mix;
    traits.reads_uv = reads_textures(m);
    scene_.traits.push_back(traits);
    scene_.material_names.push_back(m.name);
    if (!scene_.mix_of.empty()) scene_.mix_of.push_back(Scene::none);
    return static_cast<uint32_t>(scene_.materials.size() - 1);
}

// A mix has the emission, the opacity and the bumps of its own description; its parts only scatter.
uint32_t MaterialTable::add_mix(const MaterialDescription& m, uint32_t first, uint32_t second, FloatParam weight)
{
    const uint32_t id = add_plain(m, Lambert{});
    MaterialTraits& traits = scene_.traits[id];
    for (const uint32_t part : {first, second}) {
        traits.reads_uv = traits.reads_uv || scene_.traits[part].reads_uv;
        traits.mirrors = traits.mirrors || scene_.traits[part].mirrors;
    }
    scene_.mix_of.resize(scene_.materials.size(), Scene::none);
    scene_.mix_of[id] = static_cast<uint32_t>(scene_.mixes.size());
    scene_.mixes.push_back({first, second, weight});
    return id;
}

uint32_t MaterialTable::add(const MaterialDescription& m)
{
    const auto id_of = [&](const TextureUse& use) { return texture(use); };
    if (m.type == MaterialType::mix)
        return add_mix(m, named(m.first, m.where), named(m.second, m.where), {m.weight, texture(m.weight_map)});
    const bool is_metal = m.type == MaterialType::metal;
    const float metallic = m.metallic.value_or(is_metal ? 1.0f : 0.0f);
    const bool has_metallic = is_metal || m.type == MaterialType::plastic;
    if (!has_metallic || (metallic == (is_metal ? 1.0f : 0.0f) && !m.metallic_map))
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
    for (size_t i = 0; i < d_.overrides.size(); ++i) {
        const MaterialOverride& o = d_.overrides[i];
        if (fnmatch(o.match.c_str(), m.name.c_str(), 0) != 0) continue;
        override_used_[i] = true;
        return o.material.empty() ? add(o.change(m)) : named(o.material, o.where);
    }
    return add(m);
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
    std::vector<std::string> known;
    for (const auto& m : d_.materials) known.push_back(m.name);
    diagnostics_.error(where, "unknown material '" + name + "'" + suggestion(name, known));
    return default_material();
}

void MaterialTable::finish()
{
    for (size_t i = 0; i < d_.materials.size(); ++i)
        if (!used_[i])
            diagnostics_.warning(d_.materials[i].where, "material '" + d_.materials[i].name + "' is not used");
    for (size_t i = 0; i < d_.overrides.size(); ++i)
        if (!override_used_[i])
            diagnostics_.warning(d_.overrides[i].where,
                                 "no material of a mesh file matches " + in_quotes(d_.overrides[i].match));
}

}  // namespace lancer
