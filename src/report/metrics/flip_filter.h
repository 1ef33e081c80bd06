// Filters of FLIP: blurring by contrast sensitivity, and the strength of edges and points. Andersson et al. 2020,
// sections 4.1.1 and 4.2; kernels are separable. Pixels beyond the border repeat those at the border.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace lancer::flip {

// The default of the papers and of NVIDIA's tool: a display of 3840 pixels on 0.7 m, seen from 0.7 m.
inline constexpr double pixels_per_degree = 3840 * 3.14159265358979323846 / 180;

// One number per pixel, rows from the top.
struct Plane {
    size_t width = 0, height = 0;
    std::vector<float> values;

    Plane(size_t w, size_t h) : width(w), height(h), values(w * h) {}
};

// Opponent channels (flip_color.h) blurred for the viewing distance.
std::array<Plane, 3> blur_as_the_eye(const std::array<Plane, 3>& opponent);

// The strength of edges and of points in a grey plane of [0, 1]: lengths of the first and of the second derivative.
struct Features {
    Plane edges, points;
};
Features find_features(const Plane& grey);

}  // namespace lancer::flip
