// Where on a triangle a hit is: point, normals, area. Once for a single hit, and once for many, four at a time, with
// the same bits: of what surface_at() does this takes longest.
#pragma once

#include <span>

#include "geometry/hit.h"

namespace lancer {

struct Scene;

struct TrianglePlace {
    Vec3 p, p_error, n, ns;  // as in Surface, but n and ns on the front side, ns before any map
    float area = 0;          // of the whole triangle, scene units
};

// uv: barycentric weights of the second and third corner.
TrianglePlace triangle_place(const Scene& scene, uint32_t instance, uint32_t mesh, uint32_t triangle, Vec2 uv);

// places[i]: of hits[i], where that is a triangle; others stay as they are.
void triangle_places(const Scene& scene, std::span<const Hit> hits, std::span<TrianglePlace> places);

}  // namespace lancer
