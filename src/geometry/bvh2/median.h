// A binary BVH of triangles, built by median splits of the longest axis down to leaves of fewer than five triangles.
#pragma once

#include "geometry/bvh2/triangles.h"

namespace lancer {

class Median : public BinaryTriangles {
public:
    explicit Median(const TriangleSet& triangles)
        : BinaryTriangles(triangles, build_median(boxes_of(triangles), TriangleBlock::size))
    {
    }
};

}  // namespace lancer
