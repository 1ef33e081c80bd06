// Loads and stores of vectors. The numbers in memory may have any type.
#pragma once

#include <cstring>
#include <memory>

#include "core/lanes/types.h"

namespace lancer {

// Unaligned.
template <class Lanes, class T>
Lanes load_lanes(const T* from)
{
    Lanes x;
    std::memcpy(&x, from, sizeof x);
    return x;
}
template <class Lanes, class T>
void store_lanes(T* to, Lanes x)
{
    std::memcpy(to, &x, sizeof x);
}
inline Float4 load4(const float* from) { return load_lanes<Float4>(from); }
inline Double4 load4(const double* from) { return load_lanes<Double4>(from); }
inline void store4(float* to, Float4 x) { store_lanes(to, x); }
inline void store4(int32_t* to, Int4 x) { store_lanes(to, x); }
inline Float8 load8_anywhere(const float* from) { return load_lanes<Float8>(from); }
inline UInt8 load8_anywhere(const uint32_t* from) { return load_lanes<UInt8>(from); }
inline void store8_anywhere(float* to, Float8 x) { store_lanes(to, x); }
inline void store8_anywhere(uint32_t* to, UInt8 x) { store_lanes(to, x); }

// Aligned to the size of the vector.
inline Float4 load4_aligned(const float* from) { return load4(std::assume_aligned<sizeof(Float4)>(from)); }
inline UInt4 load4_aligned(const uint32_t* from) { return load_lanes<UInt4>(std::assume_aligned<sizeof(UInt4)>(from)); }
inline void store4_aligned(float* to, Float4 x) { store4(std::assume_aligned<sizeof x>(to), x); }
inline void store4_aligned(uint32_t* to, UInt4 x) { store_lanes(std::assume_aligned<sizeof x>(to), x); }
inline Float8 load8(const float* from) { return load8_anywhere(std::assume_aligned<sizeof(Float8)>(from)); }
inline UInt8 load8(const uint32_t* from) { return load8_anywhere(std::assume_aligned<sizeof(UInt8)>(from)); }
inline void store8(float* to, Float8 x) { store8_anywhere(std::assume_aligned<sizeof x>(to), x); }
inline void store8(uint32_t* to, UInt8 x) { store8_anywhere(std::assume_aligned<sizeof x>(to), x); }

// Loads two numbers from each address.
inline Float4 load2x2(const float* low, const float* high)
{
    using Double2 = double __attribute__((vector_size(16)));
    return reinterpret_cast<Float4>(Double2{load_lanes<double>(low), load_lanes<double>(high)});
}

}  // namespace lancer
