#include "io/gltf/textures.h"

#include <cmath>

#include "core/names.h"

namespace lancer {

Vec2d GltfUvTransform::apply(Vec2d uv) const
{
    const double c = std::cos(rotation), s = std::sin(rotation);
    const double u = uv.x * scale.x, v = (1 - uv.y) * scale.y;
    return {c * u + s * v + offset.x, 1 - (c * v - s * u + offset.y)};
}

GltfTextureInfo GltfTextures::info(const JsonValue* of, std::string_view key) const
{
    GltfTextureInfo i;
    if (of) i.json = doc_.object(*of, key);
    if (!i.json) return i;
    i.set = doc_.whole(*i.json, "texCoord").value_or(0);
    const JsonValue* const transform = doc_.extension(*i.json, "KHR_texture_transform");
    if (!transform) return i;
    i.set = doc_.whole(*transform, "texCoord").value_or(i.set);
    const auto offset = doc_.numbers<2>(*transform, "offset"), scale = doc_.numbers<2>(*transform, "scale");
    if (offset) i.transform.offset = {(*offset)[0], (*offset)[1]};
    if (scale) i.transform.scale = {(*scale)[0], (*scale)[1]};
    i.transform.rotation = doc_.number(*transform, "rotation").value_or(0);
    return i;
}

Wrap GltfTextures::wrap_of(const JsonValue& texture)
{
    constexpr uint64_t repeat = 10497, clamp = 33071, nearest = 9728;
    const JsonValue* const sampler = doc_.refer(texture, "sampler", "samplers");
    if (!sampler) return Wrap::repeat;
    const uint64_t s = doc_.whole(*sampler, "wrapS").value_or(repeat),
                   t = doc_.whole(*sampler, "wrapT").value_or(repeat);
    if (doc_.whole(*sampler, "magFilter") == nearest)
        doc_.warn(*sampler, "the filter NEAREST is not used: pictures are filtered linearly");
    if (s != t || (s != repeat && s != clamp))
        doc_.warn(*sampler, "mirrored repeat, and what repeats in one direction alone, are not used: it repeats");
    return s == clamp && t == clamp ? Wrap::clamp : Wrap::repeat;
}

// The name under which pictures are read; empty after a warning.
std::string GltfTextures::file_of_image(const JsonValue& image)
{
    const std::string label = "image" + std::to_string(doc_.number_of(image, "images"));
    if (const JsonValue* view = doc_.refer(image, "bufferView", "bufferViews")) {
        if (const auto part = buffers_.part_of(*view, label)) return name_of(*part);
    } else if (const std::string* uri = doc_.text(image, "uri"); uri && is_data_uri(*uri)) {
        if (const auto part = buffers_.part_of_uri(*uri, label)) return name_of(*part);
    } else if (uri) {
        const FileFinder::Found found = buffers_.find(*uri);
        if (!found.path.empty()) return found.path;
        doc_.warn(image, "texture file " + in_quotes(*uri) + " " +
                             (found.problem.empty() ? "not found" : found.problem) + "; not used");
        return {};
    } else {
        doc_.fail(image, "there is neither 'uri' nor 'bufferView'");
    }
    doc_.warn(image, "the bytes of the picture cannot be found in the file; not used");
    return {};
}

std::string GltfTextures::picture_of(const JsonValue& texture)
{
    const JsonValue* image = nullptr;
    if (const JsonValue* webp = doc_.extension(texture, "EXT_texture_webp"))
        image = doc_.refer(*webp, "source", "images");
    if (!image) image = doc_.refer(texture, "source", "images");
    if (!image) {
        doc_.warn(texture, "a texture names no picture of a format that is read; not used");
        return {};
    }
    const auto [entry, is_new] = files_.try_emplace(doc_.number_of(*image, "images"));
    if (is_new) entry->second = file_of_image(*image);
    return entry->second;
}

TextureUse GltfTextures::use(const GltfTextureInfo& info, Encoding encoding, Channel channel)
{
    if (!info.json) return {};
    const JsonValue* const texture = doc_.refer(*info.json, "index", "textures");
    if (!texture) doc_.fail(*info.json, "there is no 'index'");
    TextureDescription t;
    t.where = {doc_.path(), 0, 0};
    t.file = picture_of(*texture);
    if (t.file.empty()) return {};
    t.use = {.encoding = encoding, .channel = channel, .wrap = wrap_of(*texture)};
    return t;
}

}  // namespace lancer
