// Arithmetic on vectors beyond their operators, and the same functions for scalars.
#pragma once

#include <bit>
#include <cmath>

#include "core/lanes/masks.h"

namespace lancer {

inline double to_double(float x) { return x; }
inline Float4 to_float(Double4 x) { return __builtin_convertvector(x, Float4); }
inline float to_float(double x) { return static_cast<float>(x); }
inline float to_float(int32_t x) { return static_cast<float>(x); }
inline Float4 to_float(Int4 x) { return __builtin_convertvector(x, Float4); }
inline Float8 to_float(Int8 x) { return __builtin_convertvector(x, Float8); }

// Rounds to float and back.
inline Double4 as_stored(Double4 x) { return to_double(to_float(x)); }

// NaN where x is negative.
inline double sqrt(double x) { return std::sqrt(x); }
inline float sqrt(float x) { return std::sqrt(x); }
inline float copysign(float x, float sign) { return std::copysign(x, sign); }
inline double copysign(double x, double sign) { return std::copysign(x, sign); }
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

inline uint32_t min(uint32_t a, uint32_t b) { return a < b ? a : b; }
inline Int4 min(Int4 a, Int4 b) { return a < b ? a : b; }
inline Int4 max(Int4 a, Int4 b) { return a > b ? a : b; }
inline UInt4 min(UInt4 a, UInt4 b) { return a < b ? a : b; }

// Rounds to the nearest integer, ties to even.
inline float nearest(float x) { return std::nearbyint(x); }
// Converts integral floats in the range of int.
inline uint32_t to_whole(float x) { return static_cast<uint32_t>(static_cast<int>(x)); }
inline UInt4 to_whole(Float4 x) { return reinterpret_cast<UInt4>(truncate(x)); }
inline UInt8 to_whole(Float8 x) { return reinterpret_cast<UInt8>(truncate(x)); }

// The bits of a number, and the number of such bits.
inline uint32_t bits_of(float x) { return std::bit_cast<uint32_t>(x); }
inline UInt4 bits_of(Float4 x) { return reinterpret_cast<UInt4>(x); }
inline UInt8 bits_of(Float8 x) { return reinterpret_cast<UInt8>(x); }
inline float with_bits(uint32_t bits) { return std::bit_cast<float>(bits); }
inline Float4 with_bits(UInt4 bits) { return reinterpret_cast<Float4>(bits); }
inline Float8 with_bits(UInt8 bits) { return reinterpret_cast<Float8>(bits); }
inline int32_t as_signed(uint32_t x) { return static_cast<int32_t>(x); }
inline Int4 as_signed(UInt4 x) { return reinterpret_cast<Int4>(x); }
inline Int8 as_signed(UInt8 x) { return reinterpret_cast<Int8>(x); }
// Flips the sign where the lowest bit of `bit` is set. Bits: as bits_of(x).
template <class T, class Bits>
T negated(T x, Bits bit)
{
    return with_bits(bits_of(x) ^ (bit << 31));
}
inline bool is_odd(uint32_t x) { return x & 1; }
inline Mask4f is_odd(UInt4 x) { return reinterpret_cast<Mask4f>(-(x & 1)); }
inline Mask8 is_odd(UInt8 x) { return reinterpret_cast<Mask8>(-(x & 1)); }

}  // namespace lancer
