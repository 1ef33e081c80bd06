// Builds the materials of a scene: resolves their names, applies overrides, merges equal textures, makes mixes.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "scene/build/material_builder.h"
#include "scene/build/pending_pictures.h"
#include "scene/scene.h"

namespace lancer {

class MaterialTable {
public:
    // settings: resolved. pending: where the pictures of textures are put that are still being read.
    MaterialTable(const SceneDescription& description, const RenderSettings& settings, Scene& scene,
                  std::vector<PendingPictures::OfTexture>& pending, Diagnostics& diagnostics,
                  const RasterSource& images);

    // The id of a described material.
    uint32_t add(const MaterialDescription& material);  // equal descriptions get the same id
    // The same for a material of a mesh file, with overrides applied.
    uint32_t add_from_file(const MaterialDescription& material);
    // The id of a named material or preset; an empty name is the default grey, as is an unknown one, which is an error,
    // so that building goes on to find further errors.
    uint32_t named(const std::string& name, const Location& where);
    // The id of a changed copy of a named material, the same for the same `how`; an empty name is `otherwise`.
    uint32_t changed(const std::string& name, const Location& where, const std::string& how,
                     const MaterialDescription& otherwise,
                     const std::function<MaterialDescription(const MaterialDescription&)>& change);
    // The id of a named material with bands of another. pattern: grid or rim.
    uint32_t banded(const std::string& name, const Bands& bands, TextureType pattern, const Location& where);
    // Whether the shape of a mesh decides if a material is a thin sheet: glass that does not say it, and whose inside
    // is nothing special.
    bool may_be_thin(uint32_t id) const { return shape_decides_.count(id) > 0; }
    // The id of the same as a thin sheet. id: one that may be thin.
    uint32_t thin_version(uint32_t id);
    // Warns of unused materials.
    void finish();

private:
    uint32_t default_material();
    uint32_t make(const MaterialDescription& material);
    uint32_t texture(const TextureUse& use);
    uint32_t add_plain(const MaterialDescription& material, const Material& bsdf);
    uint32_t add_mix(const MaterialDescription& material, uint32_t first, uint32_t second, FloatParam weight);
    void resolve_named(size_t index);
    void put_camera_into(const std::string& material, const Location& where);

    const SceneDescription& d_;
    Scene& scene_;
    std::vector<PendingPictures::OfTexture>& pending_;
    Diagnostics& diagnostics_;
    const RasterSource& images_;
    IntegratorKind integrator_;
    MaterialBuilder builder_;
    std::map<std::string, std::vector<std::pair<MaterialDescription, uint32_t>>> added_;  // by name
    std::map<std::string, size_t> index_;                                                 // of names, in d_.materials
    std::map<std::string, uint32_t> presets_;  // ids of those that are in use
    std::vector<uint32_t> ids_;                // of d_.materials, or none
    std::vector<bool> used_, in_progress_, override_used_;
    std::vector<TextureDescription> textures_;                         // parallel to scene_.textures
    std::map<std::pair<std::string, std::string>, uint32_t> changed_;  // by name and way
    std::map<uint32_t, MaterialDescription> shape_decides_;            // those that may be thin
    std::map<uint32_t, uint32_t> thin_;                                // their thin versions
    uint32_t default_material_ = Scene::none;
};

}  // namespace lancer
