// Asks for memory before it is needed.
#pragma once

namespace lancer {

// So that whoever reads there some hundred cycles later need not wait. Any address will do. By asm: of a function that
// does no more than __builtin_prefetch, gcc 12 takes a call for one without effect and drops it.
inline void prefetch(const void* where) { asm volatile("prefetcht0 %0" : : "m"(*static_cast<const char*>(where))); }

}  // namespace lancer
