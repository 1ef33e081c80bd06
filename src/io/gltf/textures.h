// Textures of glTF files: which picture, how it is looked up, and with which texture coordinates.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "io/gltf/buffers.h"
#include "scene/description/texture.h"

namespace lancer {

// KHR_texture_transform, of texture coordinates with v downwards: scale, then rotation, then offset.
struct GltfUvTransform {
    Vec2d offset{0, 0}, scale{1, 1};
    double rotation = 0;  // radians, counter-clockwise
    // v points up in both.
    Vec2d apply(Vec2d uv) const;
    friend bool operator==(const GltfUvTransform& a, const GltfUvTransform& b)
    {
        return a.offset == b.offset && a.scale == b.scale && a.rotation == b.rotation;
    }
};

// A place of a material that names a texture: {"index": 3, "texCoord": 1, ...}.
struct GltfTextureInfo {
    const JsonValue* json = nullptr;  // null: there is none
    uint64_t set = 0;                 // TEXCOORD_n
    GltfUvTransform transform{};
};

class GltfTextures {
public:
    GltfTextures(GltfDocument& document, GltfBuffers& buffers) : doc_(document), buffers_(buffers) {}

    GltfTextureInfo info(const JsonValue* of, std::string_view key) const;
    // Without the transform; nothing, after a warning, if there is no such picture.
    TextureUse use(const GltfTextureInfo& info, Encoding encoding, Channel channel);

private:
    std::string picture_of(const JsonValue& texture);
    std::string file_of_image(const JsonValue& image);
    Wrap wrap_of(const JsonValue& texture);

    GltfDocument& doc_;
    GltfBuffers& buffers_;
    std::map<size_t, std::string> files_;  // of images, by their numbers
};

}  // namespace lancer
