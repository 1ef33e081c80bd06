// Makes materials from their descriptions; the only place that maps parameters.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "materials/material.h"
#include "scene/description/description.h"

namespace lancer {

// Options of the whole picture.
struct MaterialOptions {
    bool multiscatter = false;  // energy compensation for multiple scattering
    bool fresnel = true;        // false: smooth glass only refracts
};

class MaterialBuilder {
public:
    explicit MaterialBuilder(const MaterialOptions& options) : options_(options) {}

    // The BSDF of a description that is neither a mix nor partly metallic. id_of: the id of a texture.
    Material make(const MaterialDescription& description, const std::function<uint32_t(const TextureUse&)>& id_of);

private:
    MaterialOptions options_;
    std::map<float, std::shared_ptr<const AlbedoTable>> coats_;  // per index of refraction, shared by rough plastics
};

}  // namespace lancer
