// An environment map: a latitude-longitude picture in OpenEXR's convention (ImfEnvmap.h): the centre of the picture is
// +z, the top is +y, and longitude falls from +pi at the left edge to -pi at the right. Radiance is interpolated
// bilinearly between texel centres and sampled in proportion to its luminance: a row of cells and a cell by tables,
// then a point in the cell. Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., sections 12.5 and A.5.
// Where BSDF sampling finds the environment as well, sampling in proportion to what exceeds a multiple of the mean
// makes less noise: Karlik et al., "MIS Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling",
// 2019.
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
    // Radiance is texel * factor + constant; integers of the picture are colours. rotate_deg rotates the picture about
    // x, then y, then z. Texels are sampled by their luminance above `compensation` times the mean. The picture is
    // freed before the tables are made. Runs in parallel.
    EnvironmentMap(std::shared_ptr<const Raster> picture, Color factor, Color constant, Vec3d rotate_deg,
                   double compensation = 0);

    // Radiance of a ray that leaves the scene towards wi (unit).
    Color eval(Vec3 wi) const;
    // Samples a direction; radiance and density are those of eval() and pdf() for it. Must not be called unless
    // is_sampled().
    EnvironmentSample sample(Vec2 u) const;
    float pdf(Vec3 wi) const;
    // The direction as sample() would return it.
    EnvironmentSample at(Vec3 wi) const;

    uint32_t width() const { return width_; }
    uint32_t height() const { return height_; }
    // Integral over all directions of the luminance that is sampled, by the tables, which neglect the change of the
    // cosine within a cell.
    double power() const { return total_; }
    bool is_black() const { return is_black_; }
    // Whether any direction has a density.
    bool is_sampled() const { return total_ > 0; }
    // Radiance of a texel, column from the left, row from the top; 0 to width() - 1, 0 to height() - 1.
    Color texel(uint32_t column, uint32_t row) const;
    // From the directions of the picture to those of the scene.
    const Transform& to_world() const { return to_world_; }
    // Number of texels that were negative or not finite; they count as black.
    uint64_t bad_texels() const { return bad_; }
    uint64_t bytes() const { return bytes_of(width_, height_); }
    // Of a map of this size.
    static uint64_t bytes_of(uint32_t width, uint32_t height);

private:
    // Texel coordinates of a direction: x in [0, width] from the left, y in [0, height] from the top.
    struct Place {
        double x, y;
    };
    // A cell between the centres of four texels; in rows 0 and `height` between a pole and two texels.
    struct Cell {
        uint32_t row, left, right, above, below;
        double x, y;  // position in the cell, in [0, 1]
    };

    void take_texels(const Raster& picture, Color factor, Color constant);
    void make_tables(double compensation);
    void sum_weights();
    double weight(uint32_t column, uint32_t row) const;  // of a texel when sampling
    // Polar angle of the upper border of a row of cells.
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
    std::unique_ptr<double[]> in_row_;  // cumulative weights of the cells in each row
    std::unique_ptr<double[]> rows_;    // cumulative weights of the rows
    double total_ = 0;
    bool is_black_ = false;
    double threshold_ = 0;  // luminance that weights begin at
    uint64_t bad_ = 0;
};

}  // namespace lancer
