#include "geometry/bvh8_leaf.h"

namespace lancer {

uint32_t LeafRay::decide(const Bvh8Leaf& leaf, uint32_t lanes, float t_max, std::array<float, 8>& t) const
{
    uint32_t met = 0;
    for_bits(lanes, [&](uint32_t i) {
        const auto at = [&](size_t k) {
            const auto& p = leaf.corners[k];
            return Vec3{p[0][i], p[1][i], p[2][i]};
        };
        t[i] = distance_to_plane(ray_->org, ray_->dir, static_cast<int>(order_->axes[2]), at(0), at(1), at(2));
        met |= uint32_t{t[i] >= ray_->t_min && t[i] <= t_max} << i;
    });
    return met;
}

}  // namespace lancer
