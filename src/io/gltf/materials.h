// Materials of glTF files.
#pragma once

#include <optional>

#include "io/gltf/textures.h"
#include "scene/description/material.h"

namespace lancer {

struct GltfMaterial {
    MaterialDescription description;
    uint64_t uv_set = 0;                            // TEXCOORD_n, of all of its textures
    std::optional<GltfUvTransform> uv_transform{};  // of texture coordinates, where its textures alone cannot say it
    bool uses_alpha = false;                        // which vertex colours would have, too
};

// Of an element of 'materials', or the default one. What it says and cannot be had is a warning.
GltfMaterial read_gltf_material(const JsonValue* material, GltfDocument& document, GltfTextures& textures);

}  // namespace lancer
