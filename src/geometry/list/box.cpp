#include "geometry/list/box.h"

namespace lancer {

Box::Box(const TriangleSet& triangles)
{
    triangles_.reserve(triangles.size());
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        if (!triangles.is_finite(i)) continue;
        const auto [a, b, c] = triangles.corners(i);
        triangles_.push_back({a, b, c, i});
        box_.grow(box_of(a, b, c));
    }
}

}  // namespace lancer
