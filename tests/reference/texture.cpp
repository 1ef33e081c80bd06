#include "reference/texture.h"

#include <algorithm>

#include "reference/placing.h"

namespace reference {
namespace {

double fraction(double x) { return x - std::floor(x); }

// The number of a texel as the file means it.
double value_of(const lancer::Raster& raster, size_t i, bool is_curved)
{
    if (raster.floats.empty()) {
        const double v = raster.bytes[i] / 255.0;
        return is_curved ? decoded_srgb(v) : v;
    }
    const auto v = static_cast<double>(raster.floats[i]);
    if (!std::isfinite(v)) return 0;
    return is_curved && !raster.is_float ? decoded_srgb(v) : v;
}

bool alpha_says_something(const lancer::Raster& raster)
{
    if (!raster.has_alpha()) return false;
    for (size_t i = raster.channels - 1; i < raster.value_count(); i += raster.channels)
        if (value_of(raster, i, false) != 1) return true;
    return false;
}

}  // namespace

Texels::Texels(const lancer::Raster& raster, lancer::Encoding encoding, lancer::Channel channel)
    : width(static_cast<int>(raster.width)), height(static_cast<int>(raster.height))
{
    using enum lancer::Channel;
    if (channel == automatic) channel = alpha_says_something(raster) ? alpha : red;
    const bool is_curved = encoding != lancer::Encoding::linear;
    for (size_t i = 0; i < raster.value_count(); i += raster.channels) {
        const auto number = [&](size_t c) { return value_of(raster, i + (raster.channels < 3 ? 0 : c), is_curved); };
        const Rgb color{number(0), number(1), number(2)};
        switch (channel) {
            case red:
                texels.push_back(grey(color.r));
                break;
            case green:
                texels.push_back(grey(color.g));
                break;
            case blue:
                texels.push_back(grey(color.b));
                break;
            case alpha:
                texels.push_back(grey(raster.has_alpha() ? value_of(raster, i + raster.channels - 1, false) : 1));
                break;
            case luminance:
                texels.push_back(grey(reference::luminance(color)));
                break;
            default:
                texels.push_back(color);
        }
    }
}

Rgb Texels::between(double x, double y, bool repeat_x, bool repeat_y) const
{
    const auto index = [](double i, int count, bool repeat) {
        if (!repeat) return static_cast<int>(std::clamp(i, 0.0, count - 1.0));
        return static_cast<int>(i - count * std::floor(i / count));
    };
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    Rgb sum;
    for (int down = 0; down < 2; ++down)
        for (int right = 0; right < 2; ++right) {
            const double wx = 1 - std::abs(x - 0.5 - (left + right)), wy = 1 - std::abs(y - 0.5 - (top + down));
            sum += at(index(left + right, width, repeat_x), index(top + down, height, repeat_y)) * (wx * wy);
        }
    return sum;
}

Texture::Texture(const lancer::TextureDescription& what, const lancer::RasterSource& images) : what_(what)
{
    if (what.type == lancer::TextureType::image)
        picture_ = Texels(*images(what.file).get(), what.use.encoding, what.use.channel);
}

Uv Texture::placed(Uv uv) const
{
    if (what_.type == lancer::TextureType::rim) return uv;
    const auto& use = what_.use;
    return {uv.u * double{use.scale.x} + double{use.offset.x}, uv.v * double{use.scale.y} + double{use.offset.y}};
}

Rgb Texture::raw_picture(double u, double v) const
{
    const bool repeat = what_.use.wrap == lancer::Wrap::repeat;
    if (!repeat) u = std::clamp(u, 0.0, 1.0), v = std::clamp(v, 0.0, 1.0);
    return picture_.between(u * picture_.width, (1 - v) * picture_.height, repeat, repeat);
}

Rgb Texture::eval(Uv uv) const
{
    const auto [u, v] = placed(uv);
    const double band = double{what_.band_width};
    switch (what_.type) {
        case lancer::TextureType::checker:
            return rgb(fraction((std::floor(u) + std::floor(v)) / 2) == 0 ? what_.even : what_.odd);
        case lancer::TextureType::grid:
            return rgb(fraction(u) < band || fraction(v) < band ? what_.band : what_.ground);
        case lancer::TextureType::rim:
            // Barycentric coordinates in the triangle (0, 1), (1, 1), (0, 0).
            return grey(u < band || 1 - v < band || v - u < band ? 1 : 0);
        case lancer::TextureType::waves: {
            double height = 0;
            for (const lancer::Wave& w : what_.waves) {
                const double t = u * std::cos(w.direction_rad) + v * std::sin(w.direction_rad);
                height += w.amplitude * std::cos(2 * pi * t / w.wavelength + w.phase_rad);
            }
            return grey(height);
        }
        default:
            return raw_picture(u, v) * double{what_.use.gain} + grey(double{what_.use.bias});
    }
}

Uv Texture::slope(Uv uv) const
{
    const Uv at = placed(uv);
    const double u = at.u, v = at.v;  // clang 14 captures no structured bindings
    const double along_u = double{what_.use.scale.x}, along_v = double{what_.use.scale.y};
    if (is_waves()) {
        Uv sum;
        for (const lancer::Wave& w : what_.waves) {
            const double c = std::cos(w.direction_rad), s = std::sin(w.direction_rad), turns = 2 * pi / w.wavelength;
            const double rise = -w.amplitude * turns * std::sin((u * c + v * s) * turns + w.phase_rad);
            sum = sum + Uv{rise * c * along_u, rise * s * along_v};
        }
        return sum;
    }
    if (what_.type != lancer::TextureType::image) return {};
    // Half a texel to either side.
    const double du = 0.5 / picture_.width, dv = 0.5 / picture_.height, gain = double{what_.use.gain};
    const auto rise = [&](double x, double y) {
        return gain * (raw_picture(u + x, v + y).r - raw_picture(u - x, v - y).r);
    };
    return {std::copysign(rise(du, 0), along_u * rise(du, 0)), std::copysign(rise(0, dv), along_v * rise(0, dv))};
}

}  // namespace reference
