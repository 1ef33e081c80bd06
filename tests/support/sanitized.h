// Whether a sanitizer is compiled in, which takes many times the memory and the time.
#pragma once

namespace lancer {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace lancer
