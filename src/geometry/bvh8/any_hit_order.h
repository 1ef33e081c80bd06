// Traversal order for occlusion rays: children are visited by the expected saving, that is the probability of a hit per
// unit of work. Ize, Hansen, "RTSAH Traversal Order for Occlusion Rays", Computer Graphics Forum 30(2), 2011.
#pragma once

#include <algorithm>

#include "geometry/bvh8/split_reference.h"

namespace lancer {

// Expectation for a random ray that hits a box: probability of an occluder inside, and traversal work.
struct AnyHit {
    float chance;  // probability of a hit, 0 .. 1
    float work;    // > 0, in the unit of the tree's builder

    // Sort key: larger first. Finite.
    float merit() const { return chance / work; }
};

// For the box of a triangle or a part of it. The mean projected area of a convex body is a quarter of its surface: half
// of the area of a two-sided triangle, and half of box_half_area.
inline AnyHit any_hit_of(const Corners& triangle, float box_half_area, float work)
{
    const float area = 0.5f * length(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
    // Ratios outside the range of float become 1.
    return {std::min(1.0f, area / box_half_area), work};
}

// For the box around two nodes that take these shares of its half area. Rays that hit both (the shares add up to more
// than 1) visit the better one first, which saves the work of the other: the larger of the two savings.
inline AnyHit any_hit_of(const AnyHit& a, float share_a, const AnyHit& b, float share_b, float own_work)
{
    const float both = std::max(0.0f, share_a + share_b - 1);
    return {share_a * a.chance + share_b * b.chance - both * a.chance * b.chance,
            own_work + share_a * a.work + share_b * b.work - both * std::max(a.chance * b.work, b.chance * a.work)};
}

}  // namespace lancer
