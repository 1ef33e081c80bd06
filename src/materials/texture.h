// What varies over a surface: images and checkers, and the parameters of materials that they modulate.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "core/color.h"
#include "core/raster.h"
#include "core/srgb.h"
#include "core/vec.h"

namespace lancer {

// Which channel a texture of one number is taken from. automatic: alpha if the picture has one that is not 1
// everywhere, else the first; for opacity only.
enum class Channel : uint8_t { color, red, green, blue, alpha, luminance, automatic };

enum class Wrap : uint8_t { repeat, clamp };

// How an image becomes a texture.
struct ImageUse {
    Encoding encoding = Encoding::srgb;  // of integers; floats are linear
    Channel channel = Channel::color;
    Wrap wrap = Wrap::repeat;
    Vec2 scale{1, 1}, offset{0, 0};  // the picture is looked up at uv * scale + offset; v points up
    float gain = 1, bias = 0;        // value * gain + bias, after decoding
    friend bool operator==(const ImageUse&, const ImageUse&) = default;
};

class ImageTexture {
public:
    ImageTexture(const Raster& raster, const ImageUse& use);
    // uv: of the surface; width: side of the square in uv that shall be averaged over, 0 for the finest level.
    Color eval(Vec2 uv, float width) const;
    // Growth of the first channel along +u and +v, per texel of the finest level.
    Vec2 slope(Vec2 uv, float width) const;
    // Of the finest level.
    uint32_t width() const { return width_; }
    uint32_t height() const { return height_; }
    const ImageUse& use() const { return use_; }
    uint64_t bytes() const { return pixels_.size() * sizeof(Color); }

private:
    ImageUse use_;
    uint32_t width_, height_;
    std::vector<Color> pixels_;
};

// Squares of two colours: `even` where floor(u) + floor(v) is even.
struct Checker {
    Color even{1, 1, 1}, odd{};
    Vec2 scale{1, 1}, offset{0, 0};  // as for images
    Color eval(Vec2 uv, float) const
    {
        const auto cell = [](float x) { return std::floor(x); };
        const float sum = cell(uv.x * scale.x + offset.x) + cell(uv.y * scale.y + offset.y);
        return std::fmod(sum, 2.0f) == 0 ? even : odd;
    }
};

using Texture = std::variant<Checker, ImageTexture>;

inline constexpr uint32_t no_texture = UINT32_MAX;

// A parameter: a constant times a texture, if there is one.
struct ColorParam {
    Color value;
    uint32_t texture;

    constexpr ColorParam(Color v = {}, uint32_t t = no_texture) : value(v), texture(t) {}
    constexpr ColorParam(float r, float g, float b) : ColorParam(Color{r, g, b}) {}
};
struct FloatParam {
    float value;
    uint32_t texture;

    constexpr FloatParam(float v = 0, uint32_t t = no_texture) : value(v), texture(t) {}
};

// A place on a surface as far as materials may know it.
struct ShadingPoint {
    bool front = true;                  // the path arrives from the side of the geometric normal
    Vec2 uv{};                          // of the surface; only filled where the material reads textures
    float uv_width = 0;                 // footprint of the ray there, in uv
    const Texture* textures = nullptr;  // what indices of textures refer to

    Color eval(uint32_t texture) const
    {
        return std::visit([&](const auto& t) { return t.eval(uv, uv_width); }, textures[texture]);
    }
    Color eval(const ColorParam& p) const { return p.texture == no_texture ? p.value : p.value * eval(p.texture); }
    float eval(const FloatParam& p) const { return p.texture == no_texture ? p.value : p.value * eval(p.texture).r; }
};

}  // namespace lancer
