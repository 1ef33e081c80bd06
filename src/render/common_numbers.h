// Random numbers in common. Of the rays into which a path splits, one half goes by the pixel's own random numbers, the
// other by numbers that a square of 8 x 8 pixels has in common. Both halves find the same light in the mean, so what
// one finds less than the other is error and nothing else, with mean zero; and where neighbours see much the same,
// their common numbers err much alike. So the differences of all neighbours together tell how much common numbers err
// at a pixel: a control variate whose mean is known (Owen, "Monte Carlo theory, methods and examples", 2013, 8.9;
// common random numbers: 8.6), weighed as the best linear prediction weighs it. Unbiased, as the weights know where
// paths split, which was settled before, and nothing of what was found behind.
#pragma once

#include <array>
#include <span>

#include "render/kinship.h"

namespace lancer {

// Makes w ready for the samples in w.slots: nothing found yet. width: of the whole picture.
void begin_batch(const PathPlan& plan, const KernelSettings& settings, uint32_t width, Workspace& w);
// The light of sample i of w.slots, after they were traced.
Color light_of(const Workspace& w, size_t i);
// The same with the rest; of a plan with numbers in common.
Found found_of(const Workspace& w, size_t i);

// The corner of the square that a pixel is in.
inline uint32_t corner_of_square(uint32_t x_or_y) { return x_or_y / PathPlan::square * PathPlan::square; }
// f(x0, y0) of each square that has pixels of the tile: its corner.
template <class F>
void for_squares(const Tile& tile, const F& f)
{
    for (uint32_t y0 = corner_of_square(tile.y0); y0 < tile.y1; y0 += PathPlan::square)
        for (uint32_t x0 = corner_of_square(tile.x0); x0 < tile.x1; x0 += PathPlan::square) f(x0, y0);
}
// f(x, y) of each pixel of a square that the picture has: half by half, so that eight in a row lie close together.
template <class F>
void for_square(const Tile& picture, uint32_t x0, uint32_t y0, const F& f)
{
    constexpr uint32_t side = PathPlan::square;
    for (uint32_t half = x0; half < x0 + side; half += side / 2)
        for (uint32_t y = y0; y < std::min(y0 + side, picture.y1); ++y)
            for (uint32_t x = half; x < std::min(half + side / 2, picture.x1); ++x) f(x, y);
}
// f(span) of all that was found of each square and sample; it lies side by side.
template <class F>
void for_squares(std::span<const Found> found, const F& f)
{
    const auto is_same = [](const SampleId& a, const SampleId& b) {
        return a.sample == b.sample && corner_of_square(a.x) == corner_of_square(b.x) &&
               corner_of_square(a.y) == corner_of_square(b.y);
    };
    for (size_t first = 0, end = 0; first < found.size(); first = end) {
        while (end < found.size() && is_same(found[first].id, found[end].id)) ++end;
        f(found.subspan(first, end - first));
    }
}

// One sample of each pixel of a square, told by all of them together.
struct SquareLight {
    std::array<Color, square_pixels> light{};
    // Pixels of a square err together. What is to be added to the square of each luminance, so that variances of single
    // pixels, added up over a square, are that of its sum.
    std::array<double, square_pixels> together{};
    // How much pixels' luminances vary by what comes from where paths split, added up: as told, and as they were found.
    // Unbiased; the first may be below 0.
    double variance = 0, found_variance = 0;
};
// At most square_pixels. Samples that are not finite stay so and tell the others nothing.
SquareLight light_of_square(std::span<const Found> square);

}  // namespace lancer
