// How many instructions a piece of work takes: the same each time, whatever else the machine does.
#pragma once

#include <functional>
#include <optional>

namespace lancer::bench {

// User-mode instructions that the calling thread retires in work(), counted by the processor; where the system does not
// allow that, but the program runs under valgrind --tool=callgrind, by valgrind. Else work() is not called, and there
// is nothing to return.
std::optional<double> instructions_of(const std::function<void()>& work);

// Whether the program runs under valgrind: times are then those of valgrind.
bool is_under_valgrind();

}  // namespace lancer::bench
