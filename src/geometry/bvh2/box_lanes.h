// A box in two SSE registers, for building BVHs; the fourth lanes are unused.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "core/lanes/lanes.h"
#include "geometry/slab.h"

namespace lancer {

// Starts empty.
struct BoxLanes {
    Float4 lower = broadcast_to<Float4>(FloatBox::inf), upper = broadcast_to<Float4>(-FloatBox::inf);

    void grow(Float4 point) { lower = min(lower, point), upper = max(upper, point); }
    void grow(const BoxLanes& b) { lower = min(lower, b.lower), upper = max(upper, b.upper); }
    // Half the surface area; undefined for the empty box.
    float half_area() const
    {
        const Float4 d = upper - lower;
        return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
    FloatBox box() const { return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}}; }
};

// A primitive of a builder; its number is stored in the unused lane of `lower`.
struct BoxedPrimitive {
    BoxLanes box;

    BoxedPrimitive() = default;
    BoxedPrimitive(const FloatBox& b, uint32_t number)
        : box{Float4{b.lower.x, b.lower.y, b.lower.z, std::bit_cast<float>(number)},
              Float4{b.upper.x, b.upper.y, b.upper.z, 0}}
    {
    }
    uint32_t number() const { return reinterpret_cast<UInt4>(box.lower)[3]; }
    // The centre; finite even if the box is not.
    Float4 center() const
    {
        const Float4 most = broadcast_to<Float4>(std::numeric_limits<float>::max());
        return 0.5f * max(box.lower, -most) + 0.5f * min(box.upper, most);
    }
};

}  // namespace lancer
