// In which order to try what a ray meets where any hit will do: first what most likely stops the ray for the work that
// looking there costs. Ize, Hansen, "RTSAH Traversal Order for Occlusion Rays", Computer Graphics Forum 30(2), 2011.
#pragma once

#include <algorithm>

#include "geometry/bvh8/split_reference.h"

namespace lancer {

// Of a ray that meets a box, from any side: what to expect of looking for a hit in it.
struct AnyHit {
    float chance;  // that there is one, 0 .. 1
    float work;    // > 0, in the unit of the tree's builder

    // What is larger comes first. Finite.
    float merit() const { return chance / work; }
};

// Of a box around a triangle or a part of one. The mean shadow of a convex body is a quarter of its surface: half the
// triangle's area, as it has two sides, and half of box_half_area.
inline AnyHit any_hit_of(const Corners& triangle, float box_half_area, float work)
{
    const float area = 0.5f * length(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
    // What is too large or too small for float to tell becomes 1.
    return {std::min(1.0f, area / box_half_area), work};
}

// Of a box around two, which take these shares of its half area. Rays that meet both, as the shares are more than the
// whole, try the better one first, and where it stops them the work of the other is saved: the larger of the two
// savings.
inline AnyHit any_hit_of(const AnyHit& a, float share_a, const AnyHit& b, float share_b, float own_work)
{
    const float both = std::max(0.0f, share_a + share_b - 1);
    return {share_a * a.chance + share_b * b.chance - both * a.chance * b.chance,
            own_work + share_a * a.work + share_b * b.work - both * std::max(a.chance * b.work, b.chance * a.work)};
}

}  // namespace lancer
