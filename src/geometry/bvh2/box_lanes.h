// A box in two SSE registers, for building BVHs; the fourth lanes are unused.
#pragma once

#include <immintrin.h>

#include <bit>
#include <cstdint>
#include <limits>

#include "geometry/slab.h"

namespace lancer {

// Starts empty.
struct BoxLanes {
    __m128 lower = _mm_set1_ps(FloatBox::inf), upper = _mm_set1_ps(-FloatBox::inf);

    void grow(__m128 point)
    {
        lower = _mm_min_ps(lower, point);
        upper = _mm_max_ps(upper, point);
    }
    void grow(const BoxLanes& b)
    {
        lower = _mm_min_ps(lower, b.lower);
        upper = _mm_max_ps(upper, b.upper);
    }
    // Half the surface area; undefined for the empty box.
    float half_area() const
    {
        const __m128 d = upper - lower;
        return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
    FloatBox box() const { return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}}; }
};

// A primitive of a builder; its number is stored in the unused lane of `lower`.
struct BoxedPrimitive {
    BoxLanes box;

    BoxedPrimitive() = default;
    BoxedPrimitive(const FloatBox& b, uint32_t number)
        : box{_mm_setr_ps(b.lower.x, b.lower.y, b.lower.z, std::bit_cast<float>(number)),
              _mm_setr_ps(b.upper.x, b.upper.y, b.upper.z, 0)}
    {
    }
    uint32_t number() const { return static_cast<uint32_t>(_mm_extract_epi32(_mm_castps_si128(box.lower), 3)); }
    // The centre; finite even if the box is not.
    __m128 center() const
    {
        const __m128 most = _mm_set1_ps(std::numeric_limits<float>::max()), half = _mm_set1_ps(0.5f);
        return half * _mm_max_ps(box.lower, -most) + half * _mm_min_ps(box.upper, most);
    }
};

}  // namespace lancer
