// Arithmetic on vectors beyond their operators, and the same functions for scalars.
#pragma once

#include <bit>
#include <cmath>

#include "core/lanes/masks.h"

namespace lancer {

inline double to_double(float x) { return x; }
inline Float4 to_float(Double4 x) { return __builtin_convertvector(x, Float4); }
inline float to_float(double x) { return static_cast<float>(x); }
inline Float4 to_float(Int4 x) { return __builtin_convertvector(x, Float4); }
inline Float8 to_float(Int8 x) { return __builtin_convertvector(x, Float8); }

// Rounds to float and back.
inline Double4 as_stored(Double4 x) { return to_double(to_float(x)); }

// NaN where x is negative.
inline double sqrt(double x) { return std::sqrt(x); }
inline float sqrt(float x) { return std::sqrt(x); }
inline float copysign(float x, float sign) { return std::copysign(x, sign); }
inline float abs(float x) { return std::abs(x); }
inline double abs(double x) { return std::abs(x); }

// The larger number; a where b is NaN and b where a is NaN, as std::max.
template <class T>
T larger(T a, T b)
{
    return select(a < b, b, a);
}
// The smaller number, with NaN as in std::min.
template <class T>
T smaller(T a, T b)
{
    return select(b < a, b, a);
}

inline Int4 min(Int4 a, Int4 b) { return a < b ? a : b; }
inline Int4 max(Int4 a, Int4 b) { return a > b ? a : b; }
inline UInt4 min(UInt4 a, UInt4 b) { return a < b ? a : b; }

// Rounds to the nearest integer, ties to even.
inline float nearest(float x) { return std::nearbyint(x); }
// Converts integral floats in the range of int.
inline uint32_t to_whole(float x) { return static_cast<uint32_t>(static_cast<int>(x)); }
inline UInt8 to_whole(Float8 x) { return reinterpret_cast<UInt8>(truncate(x)); }
// Flips the sign where the lowest bit of `bit` is set.
inline float negated(float x, uint32_t bit) { return std::bit_cast<float>(std::bit_cast<uint32_t>(x) ^ (bit << 31)); }
inline Float8 negated(Float8 x, UInt8 bit)
{
    return reinterpret_cast<Float8>(reinterpret_cast<UInt8>(x) ^ (bit << 31));
}
inline bool is_odd(uint32_t x) { return x & 1; }
inline Mask8 is_odd(UInt8 x) { return reinterpret_cast<Mask8>(-(x & 1)); }

}  // namespace lancer
