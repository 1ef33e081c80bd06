// A picture of the surroundings in latitude-longitude or fish-eye projection, looked up by direction with bilinear
// interpolation between texel centres.
#pragma once

#include "core/image.h"
#include "core/raster.h"
#include "core/vec.h"
#include "scene/description/background.h"

namespace lancer {

class ProjectedPicture {
public:
    // how.projection: any but planar. Integers of the picture are colours.
    ProjectedPicture(const BackgroundPicture& how, const Raster& picture);

    // Pixel coordinates: x in [0, width] from the left, y in [0, height] from the top.
    struct Place {
        double x, y;
    };
    // Projection of direction d (unit, z up). Latitude-longitude: the centre of the picture is -y, +x lies a quarter of
    // the width from the left edge, the upper edge is +z. Fish-eye: +x is on the right and +y below, as a camera that
    // looks up sees them; directions beyond its rim show the rim.
    Place place_of(Vec3d d) const;
    Color eval(Vec3d d) const;

    int32_t width() const { return image_.display.width(); }
    int32_t height() const { return image_.display.height(); }
    // Approximate number of pixels per radian where the picture is finest.
    double pixels_per_radian() const;
    // Number of texels that were negative or not finite; they count as black.
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

// Sets colours that are negative or not finite to black and returns their number.
uint64_t blacken_bad_texels(Image& image);

}  // namespace lancer
