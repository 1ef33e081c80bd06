// A picture of what lies around, by latitude and longitude or through a fish-eye lens, and the way from a direction to
// a place in it. Looked up bilinearly between the middles of texels.
#pragma once

#include "core/image.h"
#include "core/raster.h"
#include "core/vec.h"
#include "scene/description/background.h"

namespace lancer {

class ProjectedPicture {
public:
    // how.projection: any but planar. Integers of the picture are sRGB.
    ProjectedPicture(const BackgroundPicture& how, const Raster& picture);

    // A place in pixels: x in [0, width] from the left, y in [0, height] from the top.
    struct Place {
        double x, y;
    };
    // d: unit, z up. Latitude and longitude: the middle of the picture is seen towards -y, +x lies a quarter of the
    // width from the left edge, the upper edge is +z. A fish-eye has +x on the right and +y below, as a camera that
    // looks up sees them; what lies beyond its rim is shown as the rim.
    Place place_of(Vec3d d) const;
    Color eval(Vec3d d) const;

    int32_t width() const { return image_.display.width(); }
    int32_t height() const { return image_.display.height(); }
    // How many pixels a radian has where the picture is finest, about.
    double pixels_per_radian() const;
    // Texels that had something negative, or no finite number: that counts as black.
    uint64_t bad_texels() const { return bad_; }
    uint64_t bytes() const { return image_.pixels.size() * sizeof(Color); }

private:
    double from_axis(Vec3d d) const;

    Projection projection_;
    double half_fov_, sin_rotation_, cos_rotation_;
    double radius_;  // of the rim, pixels
    Image image_;
    uint64_t bad_ = 0;
};

// Colours that cannot shine made black, and how many they were.
uint64_t blacken_bad_texels(Image& image);

}  // namespace lancer
