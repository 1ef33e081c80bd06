// Permutations and transposes.
#pragma once

#include "core/lanes/native.h"

namespace lancer {

inline Mask8 concat(Mask4f low, Mask4f high)
{
    return reinterpret_cast<Mask8>(concat(reinterpret_cast<Float4>(low), reinterpret_cast<Float4>(high)));
}
inline Mask8 permute(Mask8 x, UInt8 from)
{
    return reinterpret_cast<Mask8>(permute(reinterpret_cast<Float8>(x), from));
}

// Interleaves the lower two lanes of each half of a and b: a0 b0 a1 b1 a4 b4 a5 b5; or the upper two.
template <class Lanes>
Lanes interleave_low(Lanes a, Lanes b)
{
    return __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
}
template <class Lanes>
Lanes interleave_high(Lanes a, Lanes b)
{
    return __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
}
// The lanes with even indices, or with odd ones, of each half: a0 a2 b0 b2 a4 a6 b4 b6. Processors have one instruction
// for this only for floats.
inline Float8 even_lanes(Float8 a, Float8 b) { return __builtin_shufflevector(a, b, 0, 2, 8, 10, 4, 6, 12, 14); }
inline Float8 odd_lanes(Float8 a, Float8 b) { return __builtin_shufflevector(a, b, 1, 3, 9, 11, 5, 7, 13, 15); }
inline UInt8 even_lanes(UInt8 a, UInt8 b)
{
    return reinterpret_cast<UInt8>(even_lanes(reinterpret_cast<Float8>(a), reinterpret_cast<Float8>(b)));
}
inline UInt8 odd_lanes(UInt8 a, UInt8 b)
{
    return reinterpret_cast<UInt8>(odd_lanes(reinterpret_cast<Float8>(a), reinterpret_cast<Float8>(b)));
}
// Copies the upper two lanes to the lower two.
inline Float4 copy_upper_to_lower(Float4 x) { return __builtin_shufflevector(x, x, 2, 3, 2, 3); }
// Shifts the lanes up by one or two and fills with 0.
inline Double4 shift_up_1(Double4 x) { return __builtin_shufflevector(Double4{}, x, 0, 4, 5, 6); }
inline Double4 shift_up_2(Double4 x) { return __builtin_shufflevector(Double4{}, x, 0, 1, 4, 5); }

// Row i of the result has lane i of each row.
inline std::array<Float4, 4> transpose4x4(const std::array<Float4, 4>& row)
{
    const Float4 xy0 = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
    const Float4 zw0 = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
    const Float4 xy2 = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
    const Float4 zw2 = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
    return {__builtin_shufflevector(xy0, xy2, 0, 1, 4, 5), __builtin_shufflevector(xy0, xy2, 2, 3, 6, 7),
            __builtin_shufflevector(zw0, zw2, 0, 1, 4, 5), __builtin_shufflevector(zw0, zw2, 2, 3, 6, 7)};
}
inline std::array<Double4, 4> transpose4x4(const std::array<Double4, 4>& row)
{
    const Double4 xz0 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
    const Double4 yw0 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
    const Double4 xz2 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
    const Double4 yw2 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
    return {__builtin_shufflevector(xz0, xz2, 0, 1, 4, 5), __builtin_shufflevector(yw0, yw2, 0, 1, 4, 5),
            __builtin_shufflevector(xz0, xz2, 2, 3, 6, 7), __builtin_shufflevector(yw0, yw2, 2, 3, 6, 7)};
}
// Transposes each half separately.
inline std::array<Float8, 4> transpose4x4(const std::array<Float8, 4>& row)
{
    const Float8 xy0 = interleave_low(row[0], row[1]), zw0 = interleave_high(row[0], row[1]);
    const Float8 xy2 = interleave_low(row[2], row[3]), zw2 = interleave_high(row[2], row[3]);
    return {__builtin_shufflevector(xy0, xy2, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(xy0, xy2, 2, 3, 10, 11, 6, 7, 14, 15),
            __builtin_shufflevector(zw0, zw2, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(zw0, zw2, 2, 3, 10, 11, 6, 7, 14, 15)};
}

}  // namespace lancer
