// The first tree that one writes: the longest axis, cut in the middle, until fewer than five triangles are left.
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
