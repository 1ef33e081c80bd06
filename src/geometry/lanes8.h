// Eight floats at once, each computed as one alone would be. Comparisons, + - * / are those of the vector type.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace lancer {

using Float8 = float __attribute__((vector_size(32)));

inline Float8 all_lanes(float x) { return _mm256_set1_ps(x); }
// from: 32-byte aligned.
inline Float8 load8(const float* from) { return _mm256_load_ps(from); }
inline void store8(float* to, Float8 x) { _mm256_store_ps(to, x); }

// b where a is NaN.
inline Float8 min(Float8 a, Float8 b) { return _mm256_min_ps(a, b); }
inline Float8 max(Float8 a, Float8 b) { return _mm256_max_ps(a, b); }
// c - a * b, rounded once.
inline Float8 minus_product(Float8 a, Float8 b, Float8 c) { return _mm256_fnmadd_ps(a, b, c); }

// Bit i: of lane i. False where either is NaN.
inline uint32_t bits_le(Float8 a, Float8 b)
{
    return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)));
}
inline uint32_t bits_eq(Float8 a, Float8 b)
{
    return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_EQ_OQ)));
}

}  // namespace lancer
