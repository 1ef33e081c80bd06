// Flush-to-zero and denormals-are-zero, a mode of each thread that Embree recommends. Results depend on it, so every
// build sets it. C++ has no function for it: this uses instructions of x86-64.
#pragma once

#include <cstdint>

namespace lancer {

inline constexpr uint32_t flush_to_zero = 1u << 15, denormals_are_zero = 1u << 6;  // bits of MXCSR

inline uint32_t float_mode()
{
    uint32_t mode;
    asm volatile("stmxcsr %0" : "=m"(mode));
    return mode;
}
inline void set_float_mode(uint32_t mode) { asm volatile("ldmxcsr %0" : : "m"(mode) : "memory"); }
inline bool flushes_denormals()
{
    constexpr uint32_t both = flush_to_zero | denormals_are_zero;
    return (float_mode() & both) == both;
}
// Sets flush-to-zero and denormals-are-zero for this thread and for every worker that starts later. Must be called
// first in main: after the first parallel loop it reaches no worker.
inline void set_flush_denormals() { set_float_mode(float_mode() | flush_to_zero | denormals_are_zero); }

}  // namespace lancer
