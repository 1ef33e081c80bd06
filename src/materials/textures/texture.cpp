#include "materials/textures/texture.h"

#include <algorithm>
#include <bit>
#include <type_traits>

#include "core/lanes/half.h"

namespace lancer {
namespace {

// Wraps into [0, 1]. NaN becomes 0, as does infinity with Wrap::repeat.
double wrapped(double x, Wrap wrap)
{
    if (wrap == Wrap::clamp) return x > 0 ? (x < 1 ? x : 1) : 0;
    const double f = x - std::floor(x);
    return f >= 0 ? f : 0;
}

// The two of n texels around x in [0, 1], and the weight of the second. Texel i has its centre at (i + 0.5) / n.
struct Between {
    size_t first, second;
    float t;
};

Between between(double x, uint32_t n, Wrap wrap)
{
    const double place = x * n - 0.5, cell = std::floor(place);
    const auto i = static_cast<int64_t>(cell);  // -1 to n - 1
    // Masks instead of branches, which would be mispredicted.
    const int64_t last = int64_t{n} - 1, before = i >> 63, behind = (last - i - 1) >> 63;
    const int64_t behind_last = wrap == Wrap::repeat ? 0 : last, before_first = last - behind_last;
    return {.first = static_cast<size_t>((i & ~before) | (before_first & before)),
            .second = static_cast<size_t>(((i + 1) & ~behind) | (behind_last & behind)),
            .t = static_cast<float>(place - cell)};
}

struct Bytes {
    using Value = uint8_t;
    const float* decode;
    float operator()(uint8_t v) const { return decode[v]; }
};
struct Halves {
    using Value = uint16_t;
    float operator()(uint16_t v) const { return float_from_half(v); }
};
struct Floats {
    using Value = float;
    float operator()(float v) const { return v; }
};

// Access to texels of one storage format, with 1 or 3 channels.
template <class Decode, uint32_t channels>
struct Texels {
    const MipPyramid& pyramid;
    const typename Decode::Value* values;
    Decode decode;
    Wrap wrap;

    float number(const typename Decode::Value* row, Between x, uint32_t c) const
    {
        return mix(decode(row[x.first * channels + c]), decode(row[x.second * channels + c]), x.t);
    }
    Color texel(uint32_t level, uint32_t x, uint32_t y) const
    {
        const MipLevel& l = pyramid.levels[level];
        const auto* const first = values + l.first + (size_t{y} * l.width + x) * channels;
        const float r = decode(first[0]);
        if constexpr (channels == 1) return {r, r, r};
        return {r, decode(first[1]), decode(first[2])};
    }
    // u to the right and v upwards, in [0, 1].
    Color bilinear(uint32_t level, double u, double v) const
    {
        const MipLevel& l = pyramid.levels[level];
        const Between x = between(u, l.width, wrap), y = between(1 - v, l.height, wrap);
        const auto* const begin = values + l.first;
        const auto* const upper = begin + y.first * l.width * channels;
        const auto* const lower = begin + y.second * l.width * channels;
        const auto channel = [&](uint32_t c) { return mix(number(upper, x, c), number(lower, x, c), y.t); };
        const float r = channel(0);
        if constexpr (channels == 1) return {r, r, r};
        return {r, channel(1), channel(2)};
    }
};

// Calls f(texels) with the storage format as a type.
template <class F>
auto with_texels(const MipPyramid& p, Wrap wrap, const F& f)
{
    const auto with = [&](auto decode, const auto& values) {
        using Decode = decltype(decode);
        if (p.channels == 1) return f(Texels<Decode, 1>{p, values.data(), decode, wrap});
        return f(Texels<Decode, 3>{p, values.data(), decode, wrap});
    };
    if (const auto* bytes = std::get_if<0>(&p.values)) return with(Bytes{p.decode}, *bytes);
    if (const auto* halves = std::get_if<1>(&p.values)) return with(Halves{}, *halves);
    return with(Floats{}, *std::get_if<2>(&p.values));
}

float sign_of(float x) { return x > 0 ? 1.0f : x < 0 ? -1.0f : 0.0f; }

}  // namespace

ImageTexture::ImageTexture(const Raster& raster, const ImageUse& use, uint32_t limit)
    : use_(use),
      pyramid_(std::make_shared<const MipPyramid>(build_pyramid(raster, use.encoding, use.channel, limit))),
      footprint_scale_(std::max(std::abs(use.scale.x) * static_cast<float>(width()),
                                std::abs(use.scale.y) * static_cast<float>(height())))
{
}

bool ImageTexture::share(const ImageTexture& other)
{
    if (pyramid_ == other.pyramid_ || !(*pyramid_ == *other.pyramid_)) return false;
    pyramid_ = other.pyramid_;
    return true;
}

Color ImageTexture::texel(uint32_t x, uint32_t y) const
{
    return adjusted(with_texels(*pyramid_, use_.wrap, [&](const auto& texels) { return texels.texel(0, x, y); }));
}

// The blend between levels is linear in the footprint, not in its logarithm: the quality is the same, without a call of
// libm.
ImageTexture::Detail ImageTexture::detail(float width) const
{
    const float texels = width * footprint_scale_;
    if (!(texels > 1)) return {0, 0};
    const auto bits = std::bit_cast<uint32_t>(texels);
    const uint32_t level = (bits >> 23) - 127, last = static_cast<uint32_t>(pyramid_->levels.size()) - 1;
    if (level >= last) return {last, 0};
    return {level, static_cast<float>(bits & 0x7fffff) * 0x1p-23f};
}

// In double: texels stay exact for a texture repeated 100 000 times.
double ImageTexture::picture_u(double u) const
{
    return u * static_cast<double>(use_.scale.x) + static_cast<double>(use_.offset.x);
}
double ImageTexture::picture_v(double v) const
{
    return v * static_cast<double>(use_.scale.y) + static_cast<double>(use_.offset.y);
}

void ImageTexture::look_up(Vec2d uv, Footprint footprint, Color& color) const
{
    const Detail d = detail(footprint.width);
    const double u = wrapped(picture_u(uv.x), use_.wrap), v = wrapped(picture_v(uv.y), use_.wrap);
    color = adjusted(with_texels(*pyramid_, use_.wrap, [&](const auto& texels) {
        const Color fine = texels.bilinear(d.level, u, v);
        return d.next == 0 ? fine : mix(fine, texels.bilinear(d.level + 1, u, v), d.next);
    }));
}

Vec2 ImageTexture::slope(Vec2d uv, float width) const
{
    const Detail d = detail(width);
    const double u = picture_u(uv.x), v = picture_v(uv.y);
    const auto at = [&](const auto& texels, uint32_t level, double x, double y) {
        return texels.bilinear(level, wrapped(x, use_.wrap), wrapped(y, use_.wrap)).r;
    };
    const auto of_level = [&](const auto& texels, uint32_t level) {
        const MipLevel &l = pyramid_->levels[level], &finest = pyramid_->levels[0];
        const double half_u = 0.5 / l.width, half_v = 0.5 / l.height;
        const float du = at(texels, level, u + half_u, v) - at(texels, level, u - half_u, v);
        const float dv = at(texels, level, u, v + half_v) - at(texels, level, u, v - half_v);
        return Vec2{du * static_cast<float>(l.width) / static_cast<float>(finest.width),
                    dv * static_cast<float>(l.height) / static_cast<float>(finest.height)};
    };
    const Vec2 s = with_texels(*pyramid_, use_.wrap, [&](const auto& texels) {
        const Vec2 fine = of_level(texels, d.level);
        if (d.next == 0) return fine;
        const Vec2 coarse = of_level(texels, d.level + 1);
        return Vec2{mix(fine.x, coarse.x, d.next), mix(fine.y, coarse.y, d.next)};
    });
    return {s.x * use_.gain * sign_of(use_.scale.x), s.y * use_.gain * sign_of(use_.scale.y)};
}

void ShadingPoint::look_up(uint32_t texture, Color& color) const
{
    const auto look = [&]<class T>(const T& t) {
        if constexpr (std::is_same_v<T, ImageTexture>)
            t.look_up(uv_of(t), footprint_of(t), color);
        else
            color = t.eval(uv, footprint());
    };
    std::visit(look, textures[texture]);
}

}  // namespace lancer
