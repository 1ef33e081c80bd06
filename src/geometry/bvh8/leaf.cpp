#include "geometry/bvh8/leaf.h"

namespace lancer {

float LeafRay::distance(const Bvh8Leaf& leaf, uint32_t lane) const
{
    const auto at = [&](size_t k) {
        const auto& p = leaf.corners[k];
        return Vec3{p[0][lane], p[1][lane], p[2][lane]};
    };
    return distance_to_plane(ray_->org, ray_->dir, static_cast<int>(order_->axes[2]), at(0), at(1), at(2));
}

uint32_t LeafRay::decide(const Bvh8Leaf& leaf, uint32_t lanes, Bvh8Nearest& nearest, Bvh8Met& met) const
{
    if (nearest.low < nearest.high) nearest.low = nearest.high = distance(*nearest.block, nearest.lane);
    measure(leaf, lanes, met);
    uint32_t within = 0;
    for_each_lane(lanes,
                  [&](uint32_t i) { within |= uint32_t{met.t[i] >= ray_->t_min && met.t[i] <= nearest.high} << i; });
    return within;
}

}  // namespace lancer
