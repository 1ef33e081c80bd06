// Operations for which compilers do not generate the best instruction, written with intrinsics of x86-64-v3 (AVX2, FMA,
// F16C). No other file uses intrinsics. portable.h has the same functions in plain C++; native.h selects one of both.
#pragma once

#include <immintrin.h>

#include "core/lanes/types.h"

namespace lancer::x86 {

// Arithmetic. The square root of a negative number is NaN.
inline Float4 sqrt(Float4 x) { return _mm_sqrt_ps(x); }
inline Float8 sqrt(Float8 x) { return _mm256_sqrt_ps(x); }
inline Double4 sqrt(Double4 x) { return _mm256_sqrt_pd(x); }
// b where a or b is NaN or both are zero.
inline Float4 min(Float4 a, Float4 b) { return _mm_min_ps(a, b); }
inline Float8 min(Float8 a, Float8 b) { return _mm256_min_ps(a, b); }
inline Float4 max(Float4 a, Float4 b) { return _mm_max_ps(a, b); }
inline Float8 max(Float8 a, Float8 b) { return _mm256_max_ps(a, b); }
// a * b + c and c - a * b, rounded once.
inline Float8 fmadd(Float8 a, Float8 b, Float8 c) { return _mm256_fmadd_ps(a, b, c); }
inline Float8 fnmadd(Float8 a, Float8 b, Float8 c) { return _mm256_fnmadd_ps(a, b, c); }

// Signs.
inline Float4 abs(Float4 x) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), x); }
inline Float8 abs(Float8 x) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), x); }
inline Double4 abs(Double4 x) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x); }
inline Float4 copysign(Float4 x, Float4 sign)
{
    const Float4 bit = _mm_set1_ps(-0.0f);
    return _mm_or_ps(_mm_andnot_ps(bit, x), _mm_and_ps(bit, sign));
}
inline Float8 copysign(Float8 x, Float8 sign)
{
    const Float8 bit = _mm256_set1_ps(-0.0f);
    return _mm256_or_ps(_mm256_andnot_ps(bit, x), _mm256_and_ps(bit, sign));
}
inline Double4 copysign(Double4 x, Double4 sign)
{
    const Double4 bit = _mm256_set1_pd(-0.0);
    return _mm256_or_pd(_mm256_andnot_pd(bit, x), _mm256_and_pd(bit, sign));
}

// Conversions.
inline Double4 to_double(Float4 x) { return _mm256_cvtps_pd(x); }
// Rounds to the nearest integer, ties to even; follows the rounding mode of the thread.
inline Float4 nearest(Float4 x) { return _mm_round_ps(x, _MM_FROUND_CUR_DIRECTION | _MM_FROUND_NO_EXC); }
inline Float8 nearest(Float8 x) { return _mm256_round_ps(x, _MM_FROUND_CUR_DIRECTION | _MM_FROUND_NO_EXC); }
// Rounds towards zero; INT32_MIN where the result is out of range or NaN.
inline Int4 truncate(Float4 x) { return reinterpret_cast<Int4>(_mm_cvttps_epi32(x)); }
inline Int8 truncate(Float8 x) { return reinterpret_cast<Int8>(_mm256_cvttps_epi32(x)); }
// Lane i is byte i, counted from the lowest.
inline UInt8 widen_bytes(uint64_t bytes)
{
    return reinterpret_cast<UInt8>(_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<int64_t>(bytes))));
}
inline float float_from_half(uint16_t h) { return _cvtsh_ss(h); }
inline uint16_t half_from_float(float v)
{
    return static_cast<uint16_t>(_mm_cvtsi128_si32(_mm_cvtps_ph(_mm_set_ss(v), _MM_FROUND_TO_NEAREST_INT)));
}

// Masks: all bits of a lane are set, or none.
inline Float4 select(Mask4f m, Float4 yes, Float4 no) { return _mm_blendv_ps(no, yes, reinterpret_cast<__m128>(m)); }
inline Float8 select(Mask8 m, Float8 yes, Float8 no) { return _mm256_blendv_ps(no, yes, reinterpret_cast<__m256>(m)); }
inline Double4 select(Mask4 m, Double4 yes, Double4 no)
{
    return _mm256_blendv_pd(no, yes, reinterpret_cast<__m256d>(m));
}
// Bit i is the sign bit of lane i.
inline uint32_t movemask(Mask4f m) { return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(m))); }
inline uint32_t movemask(Mask8 m) { return static_cast<uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(m))); }
inline uint32_t movemask(Mask4 m) { return static_cast<uint32_t>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m))); }

// Permutations.
inline Float8 concat(Float4 low, Float4 high) { return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1); }
inline Float4 lower(Float8 x) { return _mm256_castps256_ps128(x); }
inline Float4 upper(Float8 x) { return _mm256_extractf128_ps(x, 1); }
// Lane i of the result is lane from[i] of x; higher bits of from[i] are ignored.
inline Float4 permute(Float4 x, UInt4 from) { return _mm_permutevar_ps(x, reinterpret_cast<__m128i>(from)); }
inline Float8 permute(Float8 x, UInt8 from) { return _mm256_permutevar8x32_ps(x, reinterpret_cast<__m256i>(from)); }
inline UInt8 permute(UInt8 x, UInt8 from)
{
    return reinterpret_cast<UInt8>(
        _mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(x), reinterpret_cast<__m256i>(from)));
}
// table[i] for the index i in each lane.
inline UInt8 gather(const uint32_t* table, UInt8 i)
{
    return reinterpret_cast<UInt8>(
        _mm256_i32gather_epi32(reinterpret_cast<const int*>(table), reinterpret_cast<__m256i>(i), 4));
}

// Reverses the bits of each lane: reverses the bytes and looks up each half of a byte.
struct alignas(16) SixteenBytes : std::array<uint8_t, 16> {};
inline constexpr SixteenBytes last_byte_first{{3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12}};
inline constexpr SixteenBytes reversed_half{{0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15}};
inline __m128i load(const SixteenBytes& from) { return _mm_load_si128(reinterpret_cast<const __m128i*>(from.data())); }
inline UInt4 reverse_bits(UInt4 x)
{
    const __m128i bytes = _mm_shuffle_epi8(reinterpret_cast<__m128i>(x), load(last_byte_first));
    const __m128i half = _mm_set1_epi8(15), reversed = load(reversed_half);
    const __m128i low = _mm_shuffle_epi8(reversed, _mm_and_si128(bytes, half));
    const __m128i high = _mm_shuffle_epi8(reversed, _mm_and_si128(_mm_srli_epi16(bytes, 4), half));
    return reinterpret_cast<UInt4>(_mm_or_si128(_mm_slli_epi16(low, 4), high));
}
inline UInt8 reverse_bits(UInt8 x)
{
    const __m256i order = _mm256_broadcastsi128_si256(load(last_byte_first));
    const __m256i bytes = _mm256_shuffle_epi8(reinterpret_cast<__m256i>(x), order);
    const __m256i half = _mm256_set1_epi8(15), reversed = _mm256_broadcastsi128_si256(load(reversed_half));
    const __m256i low = _mm256_shuffle_epi8(reversed, _mm256_and_si256(bytes, half));
    const __m256i high = _mm256_shuffle_epi8(reversed, _mm256_and_si256(_mm256_srli_epi16(bytes, 4), half));
    return reinterpret_cast<UInt8>(_mm256_or_si256(_mm256_slli_epi16(low, 4), high));
}

// Written in assembly: gcc 12 removes calls of functions that contain only __builtin_prefetch.
inline void prefetch(const void* where) { asm volatile("prefetcht0 %0" : : "m"(*static_cast<const char*>(where))); }

}  // namespace lancer::x86
