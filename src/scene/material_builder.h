// From what is said of a material to what is rendered: the one place that knows which parameter goes where.
#pragma once

#include <functional>

#include "materials/material.h"
#include "scene/description.h"

namespace lancer {

// Choices for the whole picture.
struct MaterialOptions {
    bool multiscatter = false;  // compensate GGX for the light that it loses between its facets
};

// The BSDF of a description that is neither a mix nor partly metallic. id_of: the id of a texture.
Material make_material(const MaterialDescription& description, const MaterialOptions& options,
                       const std::function<uint32_t(const TextureUse&)>& id_of);

}  // namespace lancer
