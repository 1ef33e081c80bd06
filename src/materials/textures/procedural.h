// Procedural textures: bands in a grid, bands along the sides of a triangle, water waves. Each is filtered over the
// footprint in closed form, so that it does not alias towards a horizon. The faded variants reproduce an older program
// for RenderSettings::legacy: they depend on the distance from the origin instead of the footprint.
#pragma once

#include <vector>

#include "core/color.h"
#include "materials/textures/footprint.h"

namespace lancer {

// `band` at the lower edges of unit cells, where the fractional part of u or v is less than `width`; else `ground`.
// Filtered over a box; an elongated footprint is replaced by the axis-aligned box of the same variances.
struct Grid {
    Color band{1, 1, 1}, ground{};
    float width = 0.05f;             // in [0, 1]
    Vec2 scale{1, 1}, offset{0, 0};  // as for images
    bool faded = false;              // not filtered, but blended with the mean along one direction far from the origin

    // `ground` if uv is not finite.
    Color eval(Vec2d uv, Footprint footprint) const;
};

// The same along the three sides of the triangle with corners (0, 1), (1, 1) and (0, 0): where a barycentric coordinate
// is less than `width`. Filtered over the part of a square inside the triangle.
struct Rim {
    float width = 0.05f;
    bool faded = false;  // not filtered

    Color eval(Vec2d uv, Footprint footprint) const;
};

// A height of amplitude * cos(2 pi t / wavelength + phase), with t along the direction, an angle from u to v.
struct Wave {
    double amplitude = 0, direction_rad = 0, wavelength = 1, phase_rad = 0;
    friend bool operator==(const Wave&, const Wave&) = default;
};

// A sum of waves: heights above a surface. Filtered by a Gaussian with the variance of the footprint, which attenuates
// a wave of length l across an extent e by exp(-(pi e / l)^2 / 6).
class Waves {
public:
    // scale, offset: as for images. faded: slopes are too small by 2 pi and fall with the distance from the origin; not
    // filtered.
    Waves(const std::vector<Wave>& waves, Vec2 scale, Vec2 offset, bool faded = false);

    Color eval(Vec2d uv, Footprint footprint) const;
    // Slope of the height per unit of u and v.
    Vec2 slope(Vec2d uv, Footprint footprint) const;

private:
    struct Term {
        double amplitude, turns_u, turns_v, turns;  // turns: phase at the origin
    };
    // Calls f(term, phase in turns, attenuation) for each wave that is not filtered out.
    template <class F>
    void for_each(Vec2d uv, Footprint footprint, const F& f) const;

    std::vector<Term> terms_;
    Vec2 scale_, offset_;
    bool faded_;
};

}  // namespace lancer
