// Powers and angles by polynomials, for one number and for several with the same bits, which are those of every
// machine: the functions of the C library are for one number, and differ between libraries. T: float or a vector of
// them.
#pragma once

#include "core/lanes/lanes.h"

namespace lancer {

// 2^x, for x <= 127; 0 where it is below the normal numbers. Error: some 2^-23 of the result. The coefficients are
// those of Cephes' exp2f.
template <class T>
T power_of_two(T x)
{
    const T whole = nearest(larger(T{} - 127.0f, x)), f = x - whole;
    const T p =
        1.0f + f * (6.931472028550421e-1f +
                    f * (2.402264791363012e-1f +
                         f * (5.550332471162809e-2f +
                              f * (9.618437357674640e-3f + f * (1.339887440266574e-3f + f * 1.535336188319500e-4f)))));
    return select(x < -126.0f, T{}, with_bits(bits_of(p) + (to_whole(whole) << 23)));
}

// The logarithm to base 2 of a normal number above 0. Error: some 2^-23 of the result, also near 1.
template <class T>
T binary_log(T x)
{
    // x = m 2^n with m in [sqrt(1/2), sqrt(2)); log m = 2 artanh s.
    constexpr uint32_t root_of_half = 0x3f3504f3;
    const auto bits = bits_of(x), n = (bits - root_of_half) & 0xff800000u;
    const T m = with_bits(bits - n), s = (m - 1.0f) / (m + 1.0f), s2 = s * s;
    const T series = 1.0f + s2 * (1.0f / 3 + s2 * (1.0f / 5 + s2 * (1.0f / 7 + s2 * (1.0f / 9))));
    return to_float(as_signed(n)) * 0x1p-23f + s * 2.88539008177792681472f * series;
}

// x^y for x in [0, 1] and y > 0, where 0^y is 0. Error: that of y log x, which is some 2^-23 of itself.
template <class T>
T power(T x, T y)
{
    return select(x > 0.0f, power_of_two(y * binary_log(x)), T{});
}

// The angle of a cosine in [0, 1]. Error below 2^-22. Abramowitz and Stegun, 4.4.46.
template <class T>
T arc_cosine(T x)
{
    const T p = 1.5707963050f +
                x * (-0.2145988016f +
                     x * (0.0889789874f +
                          x * (-0.0501743046f +
                               x * (0.0308918810f + x * (-0.0170881256f + x * (0.0066700901f + x * -0.0012624911f))))));
    return sqrt(1.0f - x) * p;
}

// The angle from the axis x to (x, y) as a part of a quarter turn, for x, y >= 0; 0 where both are 0. Error below
// 2^-22. Abramowitz and Stegun, 4.4.49.
template <class T>
T part_of_quarter(T x, T y)
{
    const auto steep = y > x;
    const T most = select(steep, y, x), t = select(steep, x, y) / select(most > 0.0f, most, T{} + 1.0f), t2 = t * t;
    const T series =
        1.0f + t2 * (-0.3333314528f +
                     t2 * (0.1999355085f +
                           t2 * (-0.1420889944f +
                                 t2 * (0.1065626393f +
                                       t2 * (-0.0752896400f +
                                             t2 * (0.0429096138f + t2 * (-0.0161657367f + t2 * 0.0028662257f)))))));
    const T part = t * series * 0.63661977236758134308f;
    return select(steep, 1.0f - part, part);
}

}  // namespace lancer
