#include "geometry/bvh8/bvh8.h"

#include <cassert>

namespace lancer {

Bvh8::Bvh8(const TriangleSet& triangles) : tree_(lay_out(build_split_tree(triangles)))
{
    assert(depth() <= max_split_depth + 1);  // what the stacks of traversal count on
}

}  // namespace lancer
