// Textures that are formulas: bands in a grid, bands along the sides of a triangle, waves of water. Each is averaged
// over the footprint in closed form, so that it neither aliases nor sparkles towards a horizon. The faded ones are
// those of an older program, for Switch::legacy: they know how far a place is from the origin, not from the eye.
#pragma once

#include <vector>

#include "core/color.h"
#include "materials/textures/footprint.h"

namespace lancer {

// `band` at the lower edges of cells of 1 by 1, where the fractional part of u or v is less than `width`; else
// `ground`. Averaged over a box; one that is seen at a slant is taken for the upright box of the same variances.
struct Grid {
    Color band{1, 1, 1}, ground{};
    float width = 0.05f;             // in [0, 1]
    Vec2 scale{1, 1}, offset{0, 0};  // as for images
    bool faded = false;              // not averaged, but blended with the mean of one direction far from the origin

    // `ground` where uv is not finite.
    Color eval(Vec2d uv, Footprint footprint) const;
};

// The same along the three sides of the triangle with the corners (0, 1), (1, 1) and (0, 0): where one of the
// barycentric coordinates is less than `width`. Averaged over that part of a square that lies in the triangle.
struct Rim {
    float width = 0.05f;
    bool faded = false;  // not averaged

    Color eval(Vec2d uv, Footprint footprint) const;
};

// A height of amplitude * cos(2 pi t / wavelength + phase), where t grows along the direction, an angle from u to v.
struct Wave {
    double amplitude = 0, direction_rad = 0, wavelength = 1, phase_rad = 0;
    friend bool operator==(const Wave&, const Wave&) = default;
};

// The sum of waves: heights above a surface. Averaged over a Gaussian with the variance of the footprint, which leaves
// of a wave of length l that meets an extent e the part exp(-(pi e / l)^2 / 6).
class Waves {
public:
    // scale, offset: as for images. faded: slopes are a 2 pi-th of what they should be and go down with the distance
    // from the origin; nothing is averaged.
    Waves(const std::vector<Wave>& waves, Vec2 scale, Vec2 offset, bool faded = false);

    Color eval(Vec2d uv, Footprint footprint) const;
    // Of the height, per unit of u and of v.
    Vec2 slope(Vec2d uv, Footprint footprint) const;

private:
    struct Term {
        double amplitude, turns_u, turns_v, turns;  // the latter at the origin
    };
    // f(term, phase in turns, what the footprint leaves of it), for each that it leaves something of.
    template <class F>
    void for_each(Vec2d uv, Footprint footprint, const F& f) const;

    std::vector<Term> terms_;
    Vec2 scale_, offset_;
    bool faded_;
};

}  // namespace lancer
