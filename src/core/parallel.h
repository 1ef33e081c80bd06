// Parallel loops. parallel.cpp is the only file that knows TBB (or std::thread, for ThreadSanitizer, which cannot
// see through the distribution's TBB).
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace lancer {

// Flush-to-zero and denormals-are-zero for this thread and every worker started afterwards. Call first in main:
// set after the first parallel loop it reaches no worker.
void set_flush_denormals();

// CPUs this process may use: min of its affinity mask and its cgroup's CPU quota; at least 1.
unsigned available_threads();

// Runs body with at most `threads` threads (>= 1, may exceed the CPUs) for every parallel loop inside it, those of
// Embree and OpenEXR included. Exceptions of body propagate. Throws Error (failed) where the system's
// limit of address space is less than so many stacks.
void with_threads(unsigned threads, const std::function<void()>& body);

// body(i) for every i in [0, count), each once, in any order and on any thread of the innermost with_threads;
// indices are handed out one by one, smallest first, so that costly items do not wait behind each other.
void parallel_for(size_t count, const std::function<void(size_t)>& body);

// Who runs the loops: "TBB 2021.8.0", of the library that is loaded, or "std::thread".
std::string parallel_version();

}  // namespace lancer
