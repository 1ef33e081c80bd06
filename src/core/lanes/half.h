// Half floats (IEEE 754 binary16), as picture files store them.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace lancer {

inline float float_from_half(uint16_t h) { return _cvtsh_ss(h); }

// To nearest; beyond 65504 infinite.
inline uint16_t half_from_float(float v) { return static_cast<uint16_t>(_cvtss_sh(v, _MM_FROUND_TO_NEAREST_INT)); }

}  // namespace lancer
