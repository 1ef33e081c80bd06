// Masks: select by mask, and masks as bits of an integer.
#pragma once

#include <array>
#include <bit>

#include "core/lanes/memory.h"
#include "core/lanes/native.h"

namespace lancer {

inline double select(bool m, double yes, double no) { return m ? yes : no; }
inline float select(bool m, float yes, float no) { return m ? yes : no; }
inline Mask4 select(Mask4 m, Mask4 yes, Mask4 no) { return (m & yes) | (~m & no); }
inline UInt8 select(Mask8 m, UInt8 yes, UInt8 no)
{
    return reinterpret_cast<UInt8>(select(m, reinterpret_cast<Float8>(yes), reinterpret_cast<Float8>(no)));
}

// Narrows a mask of four doubles to one of four floats.
inline Mask4f narrow(Mask4 m)
{
    const Mask8 halves = reinterpret_cast<Mask8>(m);
    return __builtin_shufflevector(halves, halves, 0, 2, 4, 6);
}

// Bit i is lane i of the mask.
inline uint32_t movemask(bool m) { return m; }
inline uint32_t movemask_le(Float8 a, Float8 b) { return movemask(a <= b); }
inline uint32_t movemask_eq(Float8 a, Float8 b) { return movemask(a == b); }
// a: 32-byte aligned.
inline uint32_t movemask_eq(const std::array<uint32_t, 8>& a, uint32_t b) { return movemask(load8(a.data()) == b); }
// Bit i is the sign bit of lane i, also of -0 and NaN.
inline uint32_t sign_bits(Float4 x) { return movemask(reinterpret_cast<Mask4f>(x)); }

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
