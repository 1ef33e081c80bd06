// References of the builder with spatial splits: to triangles or to their parts within a box. A triangle that crosses a
// splitting plane has a reference on either side.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "core/lanes/lanes.h"
#include "geometry/slab.h"

namespace lancer {

using Corners = std::array<Vec3, 3>;

// A FloatBox in two registers, for builders. The fourth lanes are unused. Starts empty.
struct Box4 {
    static constexpr float inf = FloatBox::inf;
    Float4 lower{inf, inf, inf, inf}, upper{-inf, -inf, -inf, -inf};

    void grow(Float4 point) { lower = min(lower, point), upper = max(upper, point); }
    void grow(const Box4& b) { lower = min(lower, b.lower), upper = max(upper, b.upper); }
    bool empty() const { return (movemask(lower > upper) & 7) != 0; }
    // Half the surface area; 0 for an empty box.
    float half_area() const
    {
        const Float4 d = max(upper - lower, Float4{});
        return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
};

inline Box4 overlap(const Box4& a, const Box4& b) { return {max(a.lower, b.lower), min(a.upper, b.upper)}; }

// The triangle's number is stored in the fourth lane of the lower corner.
struct Reference {
    Box4 box;

    Reference() = default;
    Reference(Box4 b, uint32_t number) : box(b)
    {
        UInt4 lower = reinterpret_cast<UInt4>(b.lower);
        lower[3] = number;
        box.lower = reinterpret_cast<Float4>(lower);
    }
    uint32_t number() const { return std::bit_cast<uint32_t>(static_cast<float>(box.lower[3])); }
};

inline Box4 to_box4(const FloatBox& b)
{
    return {Float4{b.lower.x, b.lower.y, b.lower.z, 0}, Float4{b.upper.x, b.upper.y, b.upper.z, 0}};
}
inline FloatBox to_box(const Box4& b)
{
    return {{b.lower[0], b.lower[1], b.lower[2]}, {b.upper[0], b.upper[1], b.upper[2]}};
}

// Clips a reference at the plane where coordinate `axis` is `at`: its parts on either side, within the reference; empty
// if there is none. Each part contains everything that the float triangle test may hit (widened() in slab.h), so both
// extend beyond the plane.
struct Clipped {
    Box4 below, above;
};
Clipped clip(const Corners& triangle, const Box4& reference, int axis, float at);

}  // namespace lancer
