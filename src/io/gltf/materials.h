// Materials of glTF files.
#pragma once

#include <optional>

#include "io/gltf/textures.h"
#include "scene/description/material.h"

namespace lancer {

struct GltfMaterial {
    MaterialDescription description;
    // TEXCOORD_n: of its first texture, and of those that name another one, of which there is at most one more.
    std::array<std::optional<uint64_t>, 2> uv_sets{};
    // Of both sets of texture coordinates, where its textures alone cannot say it.
    std::array<std::optional<GltfUvTransform>, 2> uv_transforms{};
    bool fades = false, masks = false;  // by alpha, which vertex colours may have, too
};

// Of an element of 'materials', or the default one. What it says and cannot be had is a warning.
GltfMaterial read_gltf_material(const JsonValue* material, GltfDocument& document, GltfTextures& textures);

}  // namespace lancer
