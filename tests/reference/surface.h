// The place that a ray met: where it is, its normals, its texture coordinates, and what the material says there.
#pragma once

#include "reference/closest.h"

namespace reference {

struct Surface {
    Shape shape;
    Vec p;
    Vec n, ns;   // geometric and shading normal, unit, on the side that the ray came from
    bool front;  // the side that the shape's own normal shows
    size_t material;
    Uv uv{};
    Rgb vertex_color{1, 1, 1};
};

Surface surface_at(const World& world, const Ray& ray, const Hit& hit);

// The part of the light that is stopped there, in [0, 1].
double opacity(const World& world, const Surface& s);
Rgb emission(const World& world, const Surface& s);
// Of a mix: one of its parts by chance, so that the mean is the mix. index: beyond over before, where media tell; else
// 0.
Bsdf bsdf_at(const World& world, const Surface& s, double index, Random& random);

}  // namespace reference
