// What varies over a surface: images, checkers and other formulas, and the parameters of materials that they modulate.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <variant>

#include "core/color.h"
#include "core/raster.h"
#include "core/vec.h"
#include "materials/textures/footprint.h"
#include "materials/textures/mip_pyramid.h"
#include "materials/textures/procedural.h"

namespace lancer {

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

// A picture on a surface. Trilinear: between texels, and between levels of the pyramid, by the width of the footprint.
class ImageTexture {
public:
    ImageTexture(const Raster& raster, const ImageUse& use);
    // uv: of the surface. Averaged over the square of the footprint's width, 0 for the finest level, also where it is
    // longer. A uv that is not finite gives some colour of the picture.
    Color eval(Vec2d uv, Footprint footprint) const
    {
        Color color;
        look_up(uv, footprint, color);
        return color;
    }
    // The same, not returned: see ShadingPoint::look_up().
    void look_up(Vec2d uv, Footprint footprint, Color& color) const;
    // Of the first channel, per texel of the finest level, towards +u and +v of the surface: a difference over one
    // texel of the level that the footprint asks for.
    Vec2 slope(Vec2d uv, float width) const;
    // The average of the finest level.
    Color mean() const { return adjusted(pyramid_->mean); }
    // Of the finest level.
    uint32_t width() const { return pyramid_->levels[0].width; }
    uint32_t height() const { return pyramid_->levels[0].height; }
    const ImageUse& use() const { return use_; }
    uint64_t bytes() const { return pyramid_->bytes(); }
    // Whether eval() gives the same everywhere: all texels of all levels are alike.
    bool is_constant() const { return pyramid_->is_constant(); }
    // Takes the texels of another texture for its own if they are alike; whether they are, and were not shared before.
    bool share(const ImageTexture& other);
    // How many numbers of the picture were not finite; they count as 0.
    uint64_t not_finite() const { return pyramid_->not_finite; }

private:
    struct Detail {
        uint32_t level;
        float next;  // part of the next coarser level; 0 at the coarsest
    };
    Detail detail(float width) const;
    double picture_u(double u) const;
    double picture_v(double v) const;
    Color adjusted(Color c) const { return c * use_.gain + Color{use_.bias, use_.bias, use_.bias}; }

    ImageUse use_;
    std::shared_ptr<const MipPyramid> pyramid_;
    float footprint_scale_;  // texels of the finest level per unit of uv, along the finer axis
};

// Squares of two colours: `even` where floor(u) + floor(v) is even.
struct Checker {
    Color even{1, 1, 1}, odd{};
    Vec2 scale{1, 1}, offset{0, 0};  // as for images
    // `odd` where uv is not finite.
    Color eval(Vec2d uv, Footprint) const
    {
        const auto parity = [](double x) {
            const double cell = std::floor(x);
            return cell - 2 * std::floor(cell * 0.5);
        };
        const auto place = [](double x, float factor, float shift) {
            return x * static_cast<double>(factor) + static_cast<double>(shift);
        };
        return parity(place(uv.x, scale.x, offset.x)) == parity(place(uv.y, scale.y, offset.y)) ? even : odd;
    }
};

using Texture = std::variant<Checker, ImageTexture, Grid, Rim, Waves>;

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
    Vec2d uv{};                         // of the surface; only filled where the material reads textures
    float uv_width = 0;                 // footprint of the ray there, in uv
    Vec2 uv_along{};                    // what is more of it along the ray; see Footprint
    const Texture* textures = nullptr;  // what indices of textures refer to
    Color vertex_color{1, 1, 1};        // of the mesh there, a factor of the base colour
    float eta = 0;                      // index beyond the surface over index before it, where media tell; else 0

    // Of a boundary: index behind the geometric normal over index in front of it. said: by the material itself.
    float inner_over_outer(float said) const { return eta > 0 ? (front ? eta : 1 / eta) : said; }

    // Out of line: it would stand in the kernel once for each parameter of each material, and most have no texture. Not
    // returned: what comes in registers by twos was written by ones, and would have to wait for that.
    void look_up(uint32_t texture, Color& color) const;
    Color eval(uint32_t texture) const
    {
        Color color;
        look_up(texture, color);
        return color;
    }
    Footprint footprint() const { return {uv_width, uv_along}; }
    // The same place, to be looked up in full resolution.
    ShadingPoint finest() const
    {
        ShadingPoint p = *this;
        p.uv_width = 0, p.uv_along = {};
        return p;
    }
    Color eval(const ColorParam& p) const { return p.texture == no_texture ? p.value : p.value * eval(p.texture); }
    // The base colour of a material.
    Color base(const ColorParam& p) const { return eval(p) * vertex_color; }
    float eval(const FloatParam& p) const { return p.texture == no_texture ? p.value : p.value * eval(p.texture).r; }
};

}  // namespace lancer
