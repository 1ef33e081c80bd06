#include "geometry/bvh8/split_reference.h"

namespace lancer {
namespace {

// Bounds of a polygon, extended corner by corner.
struct Extent {
    Vec3d lower{INFINITY, INFINITY, INFINITY}, upper{-INFINITY, -INFINITY, -INFINITY};

    void grow(Vec3d p)
    {
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }
    // extent: of the whole triangle
    Box4 box(float extent) const
    {
        if (lower.x > upper.x) return {};
        // Enlarged by more than the rounding to float.
        return to_box4(
            widened({to_float(lower - abs(lower) * 0x1p-23), to_float(upper + abs(upper) * 0x1p-23)}, extent));
    }
};

}  // namespace

Clipped clip(const Corners& triangle, const Box4& reference, int axis, float at)
{
    Extent below, above, whole;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d p = to_double(triangle[k]), q = to_double(triangle[(k + 1) % 3]);
        whole.grow(p);
        if (p[axis] <= at) below.grow(p);
        if (p[axis] >= at) above.grow(p);
        if ((p[axis] < at) == (q[axis] < at) || p[axis] == at || q[axis] == at) continue;
        const Vec3d crossing = p + (q - p) * ((at - p[axis]) / (q[axis] - p[axis]));
        below.grow(crossing);
        above.grow(crossing);
    }
    const auto extent = static_cast<float>(max_component(whole.upper - whole.lower));
    return {overlap(below.box(extent), reference), overlap(above.box(extent), reference)};
}

}  // namespace lancer
