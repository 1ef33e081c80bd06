// Axis-aligned box in double; starts empty.
#pragma once

#include <limits>

#include "core/vec.h"

namespace lancer {

struct Bounds {
    static constexpr double inf = std::numeric_limits<double>::infinity();
    Vec3d lower{inf, inf, inf}, upper{-inf, -inf, -inf};

    bool empty() const { return lower.x > upper.x; }
    void grow(Vec3d p)
    {
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }
    void grow(const Bounds& b)
    {
        if (b.empty()) return;
        grow(b.lower);
        grow(b.upper);
    }
    Vec3d center() const { return lower * 0.5 + upper * 0.5; }
    // Longest side; 0 for a point, and for the empty box.
    double extent() const { return empty() ? 0 : max_component(upper - lower); }
    // Half the diagonal; 0 for the empty box.
    double radius() const { return empty() ? 0 : 0.5 * length(upper - lower); }
};

}  // namespace lancer
