// What a ray meets first, by trying every triangle, sphere and plane: no accelerator and no rounding of rays. Where the
// sign of an edge function or the distance to a sphere hangs on cancellation, the arithmetic is long double.
#pragma once

#include <limits>

#include "reference/world.h"

namespace reference {

struct Ray {
    Vec org, dir;  // dir: unit
};

// The shape that a ray has just left: it is not met where it started.
enum class Kind { none, triangle, sphere, plane };
struct Shape {
    Kind kind = Kind::none;
    size_t index = 0;  // in the list of its kind in World
    friend bool operator==(const Shape&, const Shape&) = default;
};

struct Hit {
    Shape shape;
    double t = std::numeric_limits<double>::infinity();
    double v = 0, w = 0;  // triangle: weights of the second and the third corner
    explicit operator bool() const { return shape.kind != Kind::none; }
};

// In (0, t_max).
Hit closest(const World& world, const Ray& ray, Shape left = {},
            double t_max = std::numeric_limits<double>::infinity());

}  // namespace reference
