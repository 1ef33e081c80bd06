#include "geometry/bvh2/triangles.h"

#include <algorithm>
#include <atomic>

#include "core/parallel.h"

namespace lancer {
namespace {

// Calls f(i) for i below count, in parallel.
template <class F>
void for_each_number(uint32_t count, const F& f)
{
    constexpr uint32_t chunk = 1 << 13;
    parallel_for((count + chunk - 1) / chunk, [&](size_t k) {
        const uint32_t begin = static_cast<uint32_t>(k) * chunk, end = begin + std::min(chunk, count - begin);
        for (uint32_t i = begin; i < end; ++i) f(i);
    });
}

}  // namespace

std::vector<BoxedPrimitive> boxes_of(const TriangleSet& triangles)
{
    std::vector<BoxedPrimitive> boxes(triangles.size());
    std::atomic<bool> left_out = false;
    for_each_number(triangles.size(), [&](uint32_t i) {
        if (triangles.is_finite(i)) {
            const auto [a, b, c] = triangles.corners(i);
            boxes[i] = {box_of(a, b, c), i};
        } else {
            left_out = true;
        }
    });
    if (left_out) std::erase_if(boxes, [](const BoxedPrimitive& p) { return p.box.box().empty(); });
    return boxes;
}

BinaryTriangles::BinaryTriangles(const TriangleSet& triangles, BuiltTree built) : tree_(std::move(built.tree))
{
    struct Leaf {
        uint32_t first, count;
    };
    std::vector<Leaf> leaves;
    tree_.relabel_leaves([&](uint32_t first, uint32_t count) {
        leaves.push_back({first, count});
        return static_cast<uint32_t>(leaves.size() - 1);
    });
    blocks_.resize(leaves.size());
    for_each_number(static_cast<uint32_t>(leaves.size()), [&](uint32_t k) {
        for (uint32_t i = 0; i < leaves[k].count; ++i) {
            const uint32_t number = built.order[leaves[k].first + i];
            blocks_[k].set(i, triangles.corners(number), number);
        }
    });
}

}  // namespace lancer
