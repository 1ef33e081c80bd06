#include "geometry/bvh8_leaf.h"

#include <bit>

namespace lancer {

uint32_t LeafRay::confirm(uint32_t lanes, const Sheared& s)
{
    uint32_t inside = 0;
    for (; lanes; lanes &= lanes - 1) {
        const auto i = static_cast<size_t>(std::countr_zero(lanes));
        const double ax = s.ax[i], ay = s.ay[i], bx = s.bx[i], by = s.by[i], cx = s.cx[i], cy = s.cy[i];
        const double u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        // All 0: seen from its edge. Its neighbours have that edge as well.
        if (is_inside(u, v, w) && u + v + w != 0) inside |= uint32_t{1} << i;
    }
    return inside;
}

uint32_t LeafRay::decide(const Bvh8Leaf& leaf, uint32_t lanes, float t_max, std::array<float, 8>& t) const
{
    uint32_t met = 0;
    for (; lanes; lanes &= lanes - 1) {
        const auto i = static_cast<size_t>(std::countr_zero(lanes));
        const auto at = [&](size_t k) {
            const auto& p = leaf.corners[k];
            return Vec3{p[0][i], p[1][i], p[2][i]};
        };
        t[i] = distance_to_plane(ray_.org, ray_.dir, static_cast<int>(order_->axes[2]), at(0), at(1), at(2));
        met |= uint32_t{t[i] >= ray_.t_min && t[i] <= t_max} << i;
    }
    return met;
}

}  // namespace lancer
