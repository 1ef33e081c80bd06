// Parallel loops. Only parallel.cpp includes TBB (or uses std::thread, for ThreadSanitizer, which cannot follow the
// distribution's TBB).
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace lancer {

// Number of CPUs that this process may use: the minimum of its affinity mask and its cgroup's CPU quota; at least 1.
unsigned available_threads();

// Runs body with at most `threads` threads (>= 1, may exceed the CPUs) for every parallel loop inside it, those of
// Embree and OpenEXR included. Exceptions of body propagate. Throws Error (failed) where the system's
// limit of address space is less than so many stacks.
void with_threads(unsigned threads, const std::function<void()>& body);

// body(i) for every i in [0, count), each once, in any order and on any thread of the innermost with_threads;
// indices are handed out one by one, smallest first, so that costly items do not wait behind each other.
void parallel_for(size_t count, const std::function<void(size_t)>& body);

// The library that runs the loops: "TBB 2021.8.0", as loaded, or "std::thread".
std::string parallel_version();

}  // namespace lancer
