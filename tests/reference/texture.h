// Textures at full resolution, as docs/scene-format.md says what they show: pictures between the middles of their
// texels, checkers, bands, waves. Nothing is averaged over the width of rays.
#pragma once

#include <vector>

#include "core/raster.h"
#include "reference/vector.h"
#include "scene/description/description.h"

namespace reference {

struct Uv {
    double u = 0, v = 0;
};
constexpr Uv operator+(Uv a, Uv b) { return {a.u + b.u, a.v + b.v}; }
constexpr Uv operator-(Uv a, Uv b) { return {a.u - b.u, a.v - b.v}; }
constexpr Uv operator*(Uv a, double s) { return {a.u * s, a.v * s}; }

// Of what a picture's integers are: IEC 61966-2-1.
inline double decoded_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

// A picture as linear numbers, rows from the top.
struct Texels {
    int width = 0, height = 0;
    std::vector<Rgb> texels;

    Texels() = default;
    // Of one channel all three colours are alike.
    Texels(const lancer::Raster& raster, lancer::Encoding encoding, lancer::Channel channel);
    const Rgb& at(int x, int y) const
    {
        return texels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    }
    // x, y in texels from the upper left corner; beyond the edges the picture repeats or goes on as at the edge, each
    // way by itself.
    Rgb between(double x, double y, bool repeat_x, bool repeat_y) const;
};

class Texture {
public:
    // images: asked for the file of a picture, which must be there.
    Texture(const lancer::TextureDescription& what, const lancer::RasterSource& images);
    Rgb eval(Uv uv) const;
    // Of heights. Of a picture per texel towards +u and +v, of waves per step of 1 in u and in v.
    Uv slope(Uv uv) const;
    bool is_waves() const { return what_.type == lancer::TextureType::waves; }

private:
    Uv placed(Uv uv) const;
    Rgb raw_picture(double u, double v) const;

    lancer::TextureDescription what_;
    Texels picture_;
};

}  // namespace reference
