// Four doubles at once, each computed as one alone would be: the same bits, as no operation is fused or reordered.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace lancer {

using Double4 = double __attribute__((vector_size(32)));
using Mask4 = int64_t __attribute__((vector_size(32)));  // of each lane all bits or none

inline constexpr uint32_t lanes = 4, all_bits = 15;  // all_bits: bits() of a mask of all lanes

inline Double4 all_lanes(double x) { return Double4{x, x, x, x}; }

// from: four floats; to: likewise.
inline Double4 load(const float* from) { return _mm256_cvtps_pd(_mm_loadu_ps(from)); }
inline void store(float* to, Double4 x) { _mm_storeu_ps(to, _mm256_cvtpd_ps(x)); }

// As it is after being stored in float.
inline Double4 as_stored(Double4 x) { return _mm256_cvtps_pd(_mm256_cvtpd_ps(x)); }
// NaN where x is negative.
inline Double4 sqrt(Double4 x) { return _mm256_sqrt_pd(x); }
inline Double4 copysign(Double4 x, Double4 sign)
{
    const Double4 bit = all_lanes(-0.0);
    return _mm256_or_pd(_mm256_andnot_pd(bit, x), _mm256_and_pd(bit, sign));
}
inline Double4 select(Mask4 m, Double4 yes, Double4 no)
{
    return _mm256_blendv_pd(no, yes, reinterpret_cast<__m256d>(m));
}
inline Mask4 select(Mask4 m, Mask4 yes, Mask4 no) { return (m & yes) | (~m & no); }
// Bit i: lane i.
inline uint32_t bits(Mask4 m) { return static_cast<uint32_t>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m))); }

}  // namespace lancer
