// A binary BVH of triangles, built by the surface area heuristic.
#pragma once

#include "geometry/bvh2/triangles.h"

namespace lancer {

class Bvh2 : public BinaryTriangles {
public:
    explicit Bvh2(const TriangleSet& triangles)
        : BinaryTriangles(triangles, build_sah(boxes_of(triangles), TriangleBlock::size))
    {
    }
};

}  // namespace lancer
