// What the eye makes of a picture before FLIP compares: colours blurred as contrast sensitivity says, and how strong
// edges and points are. Andersson et al. 2020, sections 4.1.1 and 4.2; kernels are products of one for rows and one for
// columns. Beyond its border a picture goes on with the pixels of the border.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace lancer::flip {

// The default of the papers and of NVIDIA's tool: a display of 3840 pixels on 0.7 m, seen from 0.7 m.
inline constexpr double pixels_per_degree = 3840 * 3.14159265358979323846 / 180;

// One number for each pixel, rows from the top.
struct Plane {
    size_t width = 0, height = 0;
    std::vector<float> values;

    Plane(size_t w, size_t h) : width(w), height(h), values(w * h) {}
};

// Opponent channels (flip_color.h) as they look from a distance.
std::array<Plane, 3> blur_as_the_eye(const std::array<Plane, 3>& opponent);

// The strength of edges and of points in a grey plane of [0, 1]: lengths of the first and of the second derivative.
struct Features {
    Plane edges, points;
};
Features find_features(const Plane& grey);

}  // namespace lancer::flip
