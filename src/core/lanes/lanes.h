// SIMD types and functions. Each lane has the bits of the scalar function, as no operation is fused or reordered.
// Templates over T = float and T = Float8 use these functions for both.
#pragma once

#include <immintrin.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace lancer {

using Double4 = double __attribute__((vector_size(32)));
using Mask4 = int64_t __attribute__((vector_size(32)));  // of each lane all bits or none
using Float4 = float __attribute__((vector_size(16)));
using Mask4f = int32_t __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Mask8 = int32_t __attribute__((vector_size(32)));
using UInt8 = uint32_t __attribute__((vector_size(32)));
using ULong4 = uint64_t __attribute__((vector_size(32)));

inline constexpr uint32_t double_lanes = 4, all_bits = 15;  // all_bits: movemask() of a mask of all lanes
inline constexpr uint32_t float_lanes = 8;

inline Double4 broadcast(double x) { return Double4{x, x, x, x}; }
inline Float8 broadcast(float x) { return Float8{x, x, x, x, x, x, x, x}; }
// x as a T, which is float or Float8: for what is written once for both.
template <class T>
T broadcast_to(float x)
{
    if constexpr (std::is_same_v<T, float>)
        return x;
    else
        return broadcast(x);
}

// Joins the lower and upper four lanes, and splits them.
inline Float8 concat(Float4 low, Float4 high) { return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1); }
inline Mask8 concat(Mask4f low, Mask4f high)
{
    return reinterpret_cast<Mask8>(concat(reinterpret_cast<Float4>(low), reinterpret_cast<Float4>(high)));
}
inline Float4 lower(Float8 x) { return _mm256_castps256_ps128(x); }
inline Float4 upper(Float8 x) { return _mm256_extractf128_ps(x, 1); }

// Loads four numbers; load() converts them to double.
inline Float4 load4(const float* from) { return _mm_loadu_ps(from); }
inline Double4 load4(const double* from) { return _mm256_loadu_pd(from); }
inline Double4 load(const float* from) { return _mm256_cvtps_pd(_mm_loadu_ps(from)); }

// Builds a register from an array. Writing lanes to memory and loading them as a whole would stall on store forwarding.
inline UInt8 from_array(const std::array<uint32_t, float_lanes>& x)
{
    return UInt8{x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]};
}

// from, to: 32-byte aligned.
inline Float8 load8(const float* from) { return _mm256_load_ps(from); }
inline void store8(float* to, Float8 x) { _mm256_store_ps(to, x); }

inline Double4 to_double(Float4 x) { return _mm256_cvtps_pd(x); }
inline double to_double(float x) { return x; }
inline Float4 to_float(Double4 x) { return _mm256_cvtpd_ps(x); }
inline float to_float(double x) { return static_cast<float>(x); }

// Rounds to float and back.
inline Double4 as_stored(Double4 x) { return _mm256_cvtps_pd(_mm256_cvtpd_ps(x)); }

// NaN where x is negative.
inline Double4 sqrt(Double4 x) { return _mm256_sqrt_pd(x); }
inline Float8 sqrt(Float8 x) { return _mm256_sqrt_ps(x); }
inline double sqrt(double x) { return std::sqrt(x); }
inline float sqrt(float x) { return std::sqrt(x); }

inline Double4 copysign(Double4 x, Double4 sign)
{
    const Double4 bit = broadcast(-0.0);
    return _mm256_or_pd(_mm256_andnot_pd(bit, x), _mm256_and_pd(bit, sign));
}
inline Float8 copysign(Float8 x, Float8 sign)
{
    const Float8 bit = broadcast(-0.0f);
    return _mm256_or_ps(_mm256_andnot_ps(bit, x), _mm256_and_ps(bit, sign));
}
inline Float4 copysign(Float4 x, Float4 sign)
{
    const Float4 bit = _mm_set1_ps(-0.0f);
    return _mm_or_ps(_mm_andnot_ps(bit, x), _mm_and_ps(bit, sign));
}
inline float copysign(float x, float sign) { return std::copysign(x, sign); }

inline Double4 select(Mask4 m, Double4 yes, Double4 no)
{
    return _mm256_blendv_pd(no, yes, reinterpret_cast<__m256d>(m));
}
inline Mask4 select(Mask4 m, Mask4 yes, Mask4 no) { return (m & yes) | (~m & no); }
inline Float8 select(Mask8 m, Float8 yes, Float8 no) { return _mm256_blendv_ps(no, yes, reinterpret_cast<__m256>(m)); }
inline Float4 select(Mask4f m, Float4 yes, Float4 no) { return _mm_blendv_ps(no, yes, reinterpret_cast<__m128>(m)); }
inline UInt8 select(Mask8 m, UInt8 yes, UInt8 no)
{
    return reinterpret_cast<UInt8>(select(m, reinterpret_cast<Float8>(yes), reinterpret_cast<Float8>(no)));
}
// Lane i of the result is lane from[i] of x.
inline Float8 permute(Float8 x, UInt8 from) { return _mm256_permutevar8x32_ps(x, reinterpret_cast<__m256i>(from)); }
inline UInt8 permute(UInt8 x, UInt8 from)
{
    return reinterpret_cast<UInt8>(permute(reinterpret_cast<Float8>(x), from));
}
inline Mask8 permute(Mask8 x, UInt8 from)
{
    return reinterpret_cast<Mask8>(permute(reinterpret_cast<Float8>(x), from));
}
inline double select(bool m, double yes, double no) { return m ? yes : no; }
inline float select(bool m, float yes, float no) { return m ? yes : no; }
// Narrows a mask of four doubles to one of four floats.
inline Mask4f narrow(Mask4 m)
{
    const __m256i low =
        _mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(m), _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6));
    return reinterpret_cast<Mask4f>(_mm256_castsi256_si128(low));
}

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

// b where a is NaN.
inline Float8 min(Float8 a, Float8 b) { return _mm256_min_ps(a, b); }
inline Float8 max(Float8 a, Float8 b) { return _mm256_max_ps(a, b); }
inline Float4 min(Float4 a, Float4 b) { return _mm_min_ps(a, b); }
inline Float4 max(Float4 a, Float4 b) { return _mm_max_ps(a, b); }
inline double abs(double x) { return std::abs(x); }
inline float abs(float x) { return std::abs(x); }
inline Double4 abs(Double4 x) { return _mm256_andnot_pd(broadcast(-0.0), x); }
inline Float4 abs(Float4 x) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), x); }
inline Float8 abs(Float8 x) { return _mm256_andnot_ps(broadcast(-0.0f), x); }
// c - a * b, rounded once.
inline Float8 minus_product(Float8 a, Float8 b, Float8 c) { return _mm256_fnmadd_ps(a, b, c); }

// Rounds to the nearest integer, ties to even.
inline float nearest(float x) { return std::nearbyint(x); }
inline Float8 nearest(Float8 x) { return _mm256_round_ps(x, _MM_FROUND_CUR_DIRECTION | _MM_FROUND_NO_EXC); }
// Converts integral floats in the range of int.
inline uint32_t to_whole(float x) { return static_cast<uint32_t>(static_cast<int>(x)); }
inline UInt8 to_whole(Float8 x) { return reinterpret_cast<UInt8>(_mm256_cvttps_epi32(x)); }
// Flips the sign where the lowest bit of `bit` is set.
inline float negated(float x, uint32_t bit) { return std::bit_cast<float>(std::bit_cast<uint32_t>(x) ^ (bit << 31)); }
inline Float8 negated(Float8 x, UInt8 bit)
{
    return reinterpret_cast<Float8>(reinterpret_cast<UInt8>(x) ^ (bit << 31));
}
inline bool is_odd(uint32_t x) { return x & 1; }
inline Mask8 is_odd(UInt8 x) { return reinterpret_cast<Mask8>(-(x & 1)); }

// The sign bits of a mask: bit i is that of lane i.
inline uint32_t movemask(Mask8 m) { return static_cast<uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(m))); }
inline uint32_t movemask(bool m) { return m; }
inline uint32_t movemask(Mask4f m) { return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(m))); }
inline uint32_t movemask_le(Float8 a, Float8 b) { return movemask(a <= b); }
inline uint32_t movemask_eq(Float8 a, Float8 b) { return movemask(a == b); }
// a: 32-byte aligned.
inline uint32_t movemask_eq(const std::array<uint32_t, 8>& a, uint32_t b)
{
    const __m256i same = _mm256_cmpeq_epi32(_mm256_load_si256(reinterpret_cast<const __m256i*>(a.data())),
                                            _mm256_set1_epi32(static_cast<int>(b)));
    return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(same)));
}
inline uint32_t movemask(Mask4 m) { return static_cast<uint32_t>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m))); }

// The mask whose movemask() is `bits`.
inline Mask8 lanes_of(uint32_t bits)
{
    const Mask8 bit{1, 2, 4, 8, 16, 32, 64, 128};
    return (bit & static_cast<int>(bits)) == bit;
}

// A mask of the first n lanes.
inline Mask8 first_lanes(size_t n) { return Mask8{0, 1, 2, 3, 4, 5, 6, 7} < static_cast<int>(n); }

// Calls f(lane) for each set bit, from the lowest.
template <class F>
void for_each_lane(uint32_t bits, F&& f)
{
    for (; bits != 0; bits &= bits - 1) f(static_cast<uint32_t>(std::countr_zero(bits)));
}

}  // namespace lancer
