// The functions of x86.h in plain C++, with the same bits: for other compilers and processors, and as a reference for
// tests. C++ leaves two things open: which NaN an arithmetic operation returns, and whether min and max of a denormal
// return it or zero while denormals count as zero.
#pragma once

#include <bit>
#include <cmath>

#include "core/hash.h"
#include "core/lanes/types.h"

namespace lancer::portable {

// Lane i is f(i).
template <class Lanes, class F>
Lanes each_lane(const F& f)
{
    Lanes of{};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; ++i) of[i] = f(i);
    return of;
}

// Arithmetic.
inline Float4 sqrt(Float4 x)
{
    return each_lane<Float4>([&](size_t i) { return std::sqrt(x[i]); });
}
inline Float8 sqrt(Float8 x)
{
    return each_lane<Float8>([&](size_t i) { return std::sqrt(x[i]); });
}
inline Double4 sqrt(Double4 x)
{
    return each_lane<Double4>([&](size_t i) { return std::sqrt(x[i]); });
}
inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float8 min(Float8 a, Float8 b) { return a < b ? a : b; }
inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float8 max(Float8 a, Float8 b) { return a > b ? a : b; }
inline Float8 fmadd(Float8 a, Float8 b, Float8 c)
{
    return each_lane<Float8>([&](size_t i) { return std::fma(a[i], b[i], c[i]); });
}
inline Float8 fnmadd(Float8 a, Float8 b, Float8 c)
{
    return each_lane<Float8>([&](size_t i) { return std::fma(-a[i], b[i], c[i]); });
}

// Signs.
template <class Lanes, class Bits>
Lanes with_sign(Lanes x, Lanes sign, Bits bit)
{
    return reinterpret_cast<Lanes>((reinterpret_cast<Bits>(x) & ~bit) | (reinterpret_cast<Bits>(sign) & bit));
}
inline Float4 copysign(Float4 x, Float4 sign) { return with_sign(x, sign, UInt4{} + (1u << 31)); }
inline Float8 copysign(Float8 x, Float8 sign) { return with_sign(x, sign, UInt8{} + (1u << 31)); }
inline Double4 copysign(Double4 x, Double4 sign) { return with_sign(x, sign, ULong4{} + (uint64_t{1} << 63)); }
inline Float4 abs(Float4 x) { return copysign(x, Float4{}); }
inline Float8 abs(Float8 x) { return copysign(x, Float8{}); }
inline Double4 abs(Double4 x) { return copysign(x, Double4{}); }

// Conversions.
inline Double4 to_double(Float4 x) { return __builtin_convertvector(x, Double4); }
inline Float4 nearest(Float4 x)
{
    return each_lane<Float4>([&](size_t i) { return std::nearbyint(x[i]); });
}
inline Float8 nearest(Float8 x)
{
    return each_lane<Float8>([&](size_t i) { return std::nearbyint(x[i]); });
}
inline int32_t truncate(float x) { return x >= -0x1p31f && x < 0x1p31f ? static_cast<int32_t>(x) : INT32_MIN; }
inline Int4 truncate(Float4 x)
{
    return each_lane<Int4>([&](size_t i) { return truncate(float{x[i]}); });
}
inline Int8 truncate(Float8 x)
{
    return each_lane<Int8>([&](size_t i) { return truncate(float{x[i]}); });
}
inline UInt8 widen_bytes(uint64_t bytes)
{
    return each_lane<UInt8>([&](size_t i) { return static_cast<uint32_t>(bytes >> 8 * i & 255); });
}
inline float float_from_half(uint16_t h)
{
    const uint32_t sign = (h & 0x8000u) << 16, rest = h & 0x7fffu;
    if (rest < 0x400) return std::copysign(static_cast<float>(rest) * 0x1p-24f, std::bit_cast<float>(sign));
    if (rest < 0x7c00) return std::bit_cast<float>(sign | ((rest << 13) + (112u << 23)));
    const uint32_t quiet = rest > 0x7c00 ? 1u << 22 : 0;
    return std::bit_cast<float>(sign | 0x7f800000u | rest << 13 | quiet);
}
inline uint16_t half_from_float(float v)
{
    const uint32_t bits = std::bit_cast<uint32_t>(v), sign = bits >> 16 & 0x8000u, rest = bits & 0x7fffffffu;
    // x / 2^n, rounded to nearest, ties to even.
    const auto shifted = [](uint32_t x, uint32_t n) { return (x + (1u << (n - 1)) - 1 + (x >> n & 1)) >> n; };
    const auto half = [&] {
        if (rest > 0x7f800000u) return 0x7e00u | (rest >> 13 & 0x3ffu);
        if (rest >= 0x477ff000u) return 0x7c00u;
        if (rest >= 0x38800000u) return shifted(rest - (112u << 23), 13);
        if (rest < 0x33000000u) return 0u;
        return shifted((rest & 0x7fffffu) | 0x800000u, 126 - (rest >> 23));  // of steps of 2^-24
    };
    return static_cast<uint16_t>(sign | half());
}

// Masks.
template <class Lanes, class Mask>
Lanes select_bits(Mask m, Lanes yes, Lanes no)
{
    return reinterpret_cast<Lanes>((m & reinterpret_cast<Mask>(yes)) | (~m & reinterpret_cast<Mask>(no)));
}
inline Float4 select(Mask4f m, Float4 yes, Float4 no) { return select_bits(m, yes, no); }
inline Float8 select(Mask8 m, Float8 yes, Float8 no) { return select_bits(m, yes, no); }
inline Double4 select(Mask4 m, Double4 yes, Double4 no) { return select_bits(m, yes, no); }
template <class Mask>
uint32_t highest_bits(Mask m)
{
    uint32_t of = 0;
    for (size_t i = 0; i < sizeof m / sizeof m[0]; ++i) of |= uint32_t{m[i] < 0} << i;
    return of;
}
inline uint32_t movemask(Mask4f m) { return highest_bits(m); }
inline uint32_t movemask(Mask8 m) { return highest_bits(m); }
inline uint32_t movemask(Mask4 m) { return highest_bits(m); }

// Permutations.
inline Float8 concat(Float4 low, Float4 high) { return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7); }
inline Float4 lower(Float8 x) { return __builtin_shufflevector(x, x, 0, 1, 2, 3); }
inline Float4 upper(Float8 x) { return __builtin_shufflevector(x, x, 4, 5, 6, 7); }
inline Float4 permute(Float4 x, UInt4 from)
{
    return each_lane<Float4>([&](size_t i) { return x[from[i] & 3]; });
}
inline Float8 permute(Float8 x, UInt8 from)
{
    return each_lane<Float8>([&](size_t i) { return x[from[i] & 7]; });
}
inline UInt8 permute(UInt8 x, UInt8 from)
{
    return each_lane<UInt8>([&](size_t i) { return x[from[i] & 7]; });
}
inline UInt8 gather(const uint32_t* table, UInt8 i)
{
    return each_lane<UInt8>([&](size_t lane) { return table[i[lane]]; });
}
inline UInt4 reverse_bits(UInt4 x)
{
    return each_lane<UInt4>([&](size_t i) { return lancer::reverse_bits(x[i]); });
}
inline UInt8 reverse_bits(UInt8 x)
{
    return each_lane<UInt8>([&](size_t i) { return lancer::reverse_bits(x[i]); });
}

inline void prefetch(const void* where) { __builtin_prefetch(where); }

}  // namespace lancer::portable
