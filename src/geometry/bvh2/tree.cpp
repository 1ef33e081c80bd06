#include "geometry/bvh2/tree.h"

#include <algorithm>
#include <cassert>

namespace lancer {

void BinaryTree::Pair::set(uint32_t k, const FloatBox& box, Child c)
{
    for (int axis = 0; axis < 3; ++axis) {
        sides[axis][k] = box.lower[axis];
        sides[axis][k + 2] = box.upper[axis];
    }
    child[k] = c;
}

FloatBox BinaryTree::Pair::box(uint32_t k) const
{
    return {{sides[0][k], sides[1][k], sides[2][k]}, {sides[0][k + 2], sides[1][k + 2], sides[2][k + 2]}};
}

BinaryTree::BinaryTree(const FloatBox& box, Child root, std::vector<Pair> pairs)
    : box_(box), root_(root), pairs_(std::move(pairs))
{
    assert(depth() <= max_depth);
}

uint32_t BinaryTree::depth() const
{
    struct Entry {
        Child child;
        uint32_t depth;
    };
    uint32_t deepest = 0;
    for (std::vector<Entry> stack{{root_, 0}}; !stack.empty();) {
        const Entry at = stack.back();
        stack.pop_back();
        deepest = std::max(deepest, at.depth);
        if (empty() || at.child.count != 0) continue;
        for (const Child& c : pairs_[at.child.first].child) stack.push_back({c, at.depth + 1});
    }
    return deepest;
}

double BinaryTree::sah_cost() const
{
    const double whole = box_.half_area();
    if (!(whole > 0)) return root_.count;
    double sum = root_.count != 0 ? root_.count * whole : whole;
    for (const Pair& p : pairs_)
        for (uint32_t k = 0; k < 2; ++k)
            sum += static_cast<double>(p.box(k).half_area()) * std::max(1u, p.child[k].count);
    return sum / whole;
}

}  // namespace lancer
