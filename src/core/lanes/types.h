// Vector types of GCC and clang, which have the operators of scalars.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace lancer {

using Float4 = float __attribute__((vector_size(16)));
using UInt4 = uint32_t __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using UInt8 = uint32_t __attribute__((vector_size(32)));
using Int8 = int32_t __attribute__((vector_size(32)));
using Double4 = double __attribute__((vector_size(32)));
using ULong4 = uint64_t __attribute__((vector_size(32)));

// Results of comparisons: all bits of a lane are set, or none.
using Mask4f = Int4;
using Mask8 = Int8;
using Mask4 = decltype(Double4{} < Double4{});  // compilers differ in the element type

inline constexpr uint32_t double_lanes = 4, all_bits = 15;  // all_bits: movemask() of a mask of all lanes
inline constexpr uint32_t float_lanes = 8;

inline Double4 broadcast(double x) { return Double4{x, x, x, x}; }
inline Float8 broadcast(float x) { return Float8{x, x, x, x, x, x, x, x}; }
// x as a T, which is float, Float4 or Float8: for templates over them.
template <class T>
T broadcast_to(float x)
{
    if constexpr (std::is_same_v<T, float>)
        return x;
    else if constexpr (std::is_same_v<T, Float4>)
        return Float4{x, x, x, x};
    else
        return broadcast(x);
}

// Builds a register from an array. Writing lanes to memory and loading them as a whole would stall on store forwarding.
inline UInt8 from_array(const std::array<uint32_t, float_lanes>& x)
{
    return UInt8{x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]};
}

}  // namespace lancer
