// Boxes in float and their conservative ray test: it never misses a box that the exact test, or the float test of a
// triangle inside, would hit. Williams et al., "An Efficient and Robust Ray-Box Intersection Algorithm", JGT 10(1),
// 2005; the far sides are enlarged by the rounding errors of the quotients: Ize, "Robust BVH Ray Traversal", JCGT 2(2),
// 2013.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ray.h"

namespace lancer {

// Starts empty.
struct FloatBox {
    static constexpr float inf = std::numeric_limits<float>::infinity();
    Vec3 lower{inf, inf, inf}, upper{-inf, -inf, -inf};

    bool empty() const { return lower.x > upper.x; }
    void grow(const FloatBox& b)
    {
        lower = {std::min(lower.x, b.lower.x), std::min(lower.y, b.lower.y), std::min(lower.z, b.lower.z)};
        upper = {std::max(upper.x, b.upper.x), std::max(upper.y, b.upper.y), std::max(upper.z, b.upper.z)};
    }
    // Half the surface area; 0 for the empty box.
    float half_area() const
    {
        if (empty()) return 0;
        const Vec3 d = upper - lower;
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
};

// The smallest float box that contains a double box; empty for the empty box.
inline FloatBox rounded_outwards(Vec3d lower, Vec3d upper)
{
    const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -FloatBox::inf); };
    const auto up = [](double x) { return std::nextafter(static_cast<float>(x), FloatBox::inf); };
    return {{down(lower.x), down(lower.y), down(lower.z)}, {up(upper.x), up(upper.y), up(upper.z)}};
}

// The box of a triangle or a part of it, enlarged by the error of the triangle test in float: the edge functions err by
// a fraction of the triangle's extent, the corners by a fraction of their coordinates. extent: longest side of the box
// of the whole triangle.
inline FloatBox widened(FloatBox box, float extent)
{
    const float own = gamma(16) * extent;
    const auto margin = [&](Vec3 p) { return abs(p) * gamma(2) + Vec3{own, own, own}; };
    return {box.lower - margin(box.lower), box.upper + margin(box.upper)};
}

inline FloatBox box_of(Vec3 a, Vec3 b, Vec3 c)
{
    const FloatBox box{{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
                       {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
    return widened(box, max_component(box.upper - box.lower));
}

// Precomputed data of a ray for box tests.
struct SlabRay {
    static constexpr float widening = 1 + gamma(10);  // factor of the far distances
    Vec3 org, inverse, far_inverse;
    float t_min;

    explicit SlabRay(const Ray& r) : org(r.org), inverse{1 / r.dir.x, 1 / r.dir.y, 1 / r.dir.z}, t_min(r.t_min)
    {
        far_inverse = inverse * widening;
    }
};

// Tests the interval [t_min, t_max]. 0 * infinity, for a ray within the plane of a side, makes the test more
// conservative: min and max return their second argument if the first is NaN.
inline bool meets(const FloatBox& b, const SlabRay& r, float t_max)
{
    float near = r.t_min, far = t_max;
    for (int k = 0; k < 3; ++k) {
        const bool back = std::signbit(r.inverse[k]);
        const float t0 = ((back ? b.upper[k] : b.lower[k]) - r.org[k]) * r.inverse[k];
        const float t1 = ((back ? b.lower[k] : b.upper[k]) - r.org[k]) * r.far_inverse[k];
        near = t0 > near ? t0 : near;
        far = t1 < far ? t1 : far;
    }
    return near <= far;
}

}  // namespace lancer
