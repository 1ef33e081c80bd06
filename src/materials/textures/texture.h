// Textures: images, checkers and other formulas, and the material parameters that they modulate.
#pragma once

#include <algorithm>
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

// Options of an image texture.
struct ImageUse {
    Encoding encoding = Encoding::of_file;  // of integers; floats are linear
    Channel channel = Channel::color;
    Wrap wrap = Wrap::repeat;
    bool by_second_uv = false;       // looked up by the second set of texture coordinates of a mesh
    Vec2 scale{1, 1}, offset{0, 0};  // lookup at uv * scale + offset; v points up
    float gain = 1, bias = 0;        // value * gain + bias, after decoding
    friend bool operator==(const ImageUse&, const ImageUse&) = default;
};

// An image texture with trilinear filtering: between texels, and between mip levels by the width of the footprint.
class ImageTexture {
public:
    // limit: as for build_pyramid().
    ImageTexture(const Raster& raster, const ImageUse& use, uint32_t limit = 0);
    // uv: of the surface. Filtered over the square of the footprint's width; 0: the finest level. A uv that is not
    // finite gives some colour of the picture.
    Color eval(Vec2d uv, Footprint footprint) const
    {
        Color color;
        look_up(uv, footprint, color);
        return color;
    }
    // The same by reference; see ShadingPoint::look_up().
    void look_up(Vec2d uv, Footprint footprint, Color& color) const;
    // Slope of the first channel, per texel of the finest level, along +u and +v: the difference over one texel of the
    // footprint's mip level.
    Vec2 slope(Vec2d uv, float width) const;
    // A texel of the finest level, gain and bias included; x from the left, y from the top, within the picture.
    Color texel(uint32_t x, uint32_t y) const;
    // Whether some texel needs more than the 16 bits of half floats, or 8 bits and their decoding.
    bool has_floats() const { return std::holds_alternative<std::vector<float>>(pyramid_->values); }
    // Mean of the finest level.
    Color mean() const { return adjusted(pyramid_->mean); }
    // Size of the finest level.
    uint32_t width() const { return pyramid_->levels[0].width; }
    uint32_t height() const { return pyramid_->levels[0].height; }
    const ImageUse& use() const { return use_; }
    uint64_t bytes() const { return pyramid_->bytes(); }
    // Whether the texture is constant: all texels of all levels are equal.
    bool is_constant() const { return pyramid_->is_constant(); }
    // Shares the texels of another texture if they are equal; returns whether they are and were not shared before.
    bool share(const ImageTexture& other);
    // Number of values of the picture that were not finite; they count as 0.
    uint64_t not_finite() const { return pyramid_->not_finite; }

private:
    struct Detail {
        uint32_t level;
        float next;  // weight of the next coarser level; 0 at the coarsest
    };
    Detail detail(float width) const;
    double picture_u(double u) const;
    double picture_v(double v) const;
    Color adjusted(Color c) const { return c * use_.gain + Color{use_.bias, use_.bias, use_.bias}; }

    ImageUse use_;
    std::shared_ptr<const MipPyramid> pyramid_;
    float footprint_scale_;  // texels of the finest level per unit of uv, along the finer axis
};

// Checker texture: `even` where floor(u) + floor(v) is even.
struct Checker {
    Color even{1, 1, 1}, odd{};
    Vec2 scale{1, 1}, offset{0, 0};  // as for images
    // `odd` if uv is not finite.
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

// A material parameter: a constant times an optional texture.
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

// A surface point as materials see it.
struct ShadingPoint {
    bool front = true;                  // on the side of the geometric normal
    Vec2d uv{};                         // only set if the material reads textures
    float uv_width = 0;                 // footprint of the ray cone, in uv
    Vec2 uv_along{};                    // elongation along the ray; see Footprint
    const Texture* textures = nullptr;  // the scene's textures
    Color vertex_color{1, 1, 1};        // of the mesh; a factor of the base colour
    float eta = 0;                      // relative index from the media; 0: that of the material
    Vec2 tangent{1, 0};                 // cosine and sine in the local frame; only set if the material has a tangent
    float second_uv_width = 0;          // as uv_width, of:
    Vec2 second_uv{};                   // the second set; only set if the material reads it

    // Index behind the geometric normal over index in front of it. said: the material's own index.
    float inner_over_outer(float said) const { return eta > 0 ? (front ? eta : 1 / eta) : said; }

    // Not inlined: the kernel would contain it once per parameter of each material, and most have no texture. By
    // reference, as returning a colour in registers would stall.
    void look_up(uint32_t texture, Color& color) const;
    Color eval(uint32_t texture) const
    {
        Color color;
        look_up(texture, color);
        return color;
    }
    Footprint footprint() const { return {uv_width, uv_along}; }
    // Where an image is looked up.
    Vec2d uv_of(const ImageTexture& image) const { return image.use().by_second_uv ? Vec2d(second_uv) : uv; }
    Footprint footprint_of(const ImageTexture& image) const
    {
        return image.use().by_second_uv ? Footprint{second_uv_width, {}} : footprint();
    }
    // The same point for lookups at full resolution.
    ShadingPoint finest() const
    {
        ShadingPoint p = *this;
        p.uv_width = p.second_uv_width = 0, p.uv_along = {};
        return p;
    }
    // What a picture holds below 0, or as NaN, counts as 0.
    Color eval(const ColorParam& p) const
    {
        return p.texture == no_texture ? p.value : p.value * at_least_0(eval(p.texture));
    }
    // The same of a part of the light: what a picture has above 1 counts as 1.
    Color part(const ColorParam& p) const { return p.texture == no_texture ? p.value : at_most_1(eval(p)); }
    // Base colour of a material: parameter times vertex colour.
    Color base(const ColorParam& p) const { return part(p) * vertex_color; }
    float eval(const FloatParam& p) const { return p.texture == no_texture ? p.value : p.value * eval(p.texture).r; }

private:
    static Color at_least_0(Color c) { return {std::max(0.0f, c.r), std::max(0.0f, c.g), std::max(0.0f, c.b)}; }
    static Color at_most_1(Color c) { return {std::min(1.0f, c.r), std::min(1.0f, c.g), std::min(1.0f, c.b)}; }
};

}  // namespace lancer
