// Light from infinitely far away, by a latitude-longitude picture: OpenEXR's convention (ImfEnvmap.h), in which the
// centre of the picture is +z, the top is +y, and longitude falls from +pi at the left edge to -pi at the right.
// Looked up bilinearly between the middles of texels, and drawn in proportion to the luminance of that: a row of cells
// and a cell from tables, then a place in the cell. Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed.,
// sections 12.5 and A.5.
#pragma once

#include <memory>

#include "core/color.h"
#include "core/raster.h"
#include "core/transform.h"
#include "core/vec.h"

namespace lancer {

struct EnvironmentSample {
    Vec3 wi;  // unit
    Color radiance;
    float pdf = 0;  // per solid angle
};

class EnvironmentMap {
public:
    // Radiance is texel * factor + constant; integers of the picture are sRGB. rotate_deg turns the picture about x,
    // then y, then z. The picture is let go of before the tables are made. Runs in parallel.
    EnvironmentMap(std::shared_ptr<const Raster> picture, Color factor, Color constant, Vec3d rotate_deg);

    // Radiance that arrives along a ray that leaves the scene towards wi (unit).
    Color eval(Vec3 wi) const;
    // Not where is_black(). The radiance and the density are those of wi as eval() and pdf() find them.
    EnvironmentSample sample(Vec2 u) const;
    float pdf(Vec3 wi) const;

    uint32_t width() const { return width_; }
    uint32_t height() const { return height_; }
    // Integral of the radiance's luminance over all directions, as the tables have it: exact but for the change of the
    // cosine within a cell.
    double power() const { return total_; }
    bool is_black() const { return total_ == 0; }
    // Texels that had something negative, or no finite number: that counts as black.
    uint64_t bad_texels() const { return bad_; }
    uint64_t bytes() const;

private:
    // A direction in texels: x in [0, width] from the left, y in [0, height] from the top.
    struct Place {
        double x, y;
    };
    // What lies between the middles of four texels; in the rows 0 and `height` between a pole and two of them.
    struct Cell {
        uint32_t row, left, right, above, below;
        double x, y;  // of a place in it, in [0, 1]
    };

    void take_texels(const Raster& picture, Color factor, Color constant);
    void make_tables();
    Color texel(uint32_t column, uint32_t row) const;
    double texel_luminance(uint32_t column, uint32_t row) const;
    // Polar angle of the border above a row of cells.
    double border(uint32_t row) const;
    double solid_angle(uint32_t row) const;  // of a cell
    Place place_of(Vec3 wi) const;
    Vec3 direction_of(Place p) const;
    Cell cell_of(Place p) const;
    Color lookup(Place p) const;
    float pdf(Place p) const;

    uint32_t width_, height_;
    Transform to_world_;
    std::unique_ptr<float[]> texels_;   // RGB, rows from the top
    std::unique_ptr<double[]> in_row_;  // of each cell the weights of its row up to and including it
    std::unique_ptr<double[]> rows_;    // of each row of cells the weights of the rows up to and including it
    double total_ = 0;
    uint64_t bad_ = 0;
};

}  // namespace lancer
