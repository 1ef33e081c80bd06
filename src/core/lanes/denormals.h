// Flush-to-zero and denormals-are-zero, a mode of each thread that Embree recommends. Results depend on it, so every
// build sets it. C++ has no function for it: this uses instructions of x86-64 and of arm64.
#pragma once

#include <cstdint>

namespace lancer {

#if defined(__aarch64__)

inline constexpr uint64_t flush_bits = uint64_t{1} << 24;  // FZ of FPCR: operands and results

inline uint64_t float_mode()
{
    uint64_t mode;
    asm volatile("mrs %0, fpcr" : "=r"(mode));
    return mode;
}
inline void set_float_mode(uint64_t mode) { asm volatile("msr fpcr, %0" : : "r"(mode) : "memory"); }

#else

inline constexpr uint64_t flush_bits = 1u << 15 | 1u << 6;  // of MXCSR: results, and operands

inline uint64_t float_mode()
{
    uint32_t mode;
    asm volatile("stmxcsr %0" : "=m"(mode));
    return mode;
}
inline void set_float_mode(uint64_t mode)
{
    const auto low = static_cast<uint32_t>(mode);
    asm volatile("ldmxcsr %0" : : "m"(low) : "memory");
}

#endif

inline bool flushes_denormals() { return (float_mode() & flush_bits) == flush_bits; }
// Sets flush-to-zero and denormals-are-zero for this thread and for every worker that starts later. Must be called
// first in main: after the first parallel loop it reaches no worker.
inline void set_flush_denormals() { set_float_mode(float_mode() | flush_bits); }

}  // namespace lancer
