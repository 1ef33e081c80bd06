// Times of things to compare, taken in turns so that whatever disturbs the machine disturbs all of them alike: after a
// round to warm up, each round runs every contestant once, in an order of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"

namespace lancer::bench {

struct Contestant {
    std::string name;
    double items = 1;  // rays, triangles, samples: what one run does
    std::function<void()> run;
    std::function<double()> timed = {};  // instead, for what takes its own time: nanoseconds of CPU
};

// Nanoseconds per item, one of each round; round r of one contestant and of another ran side by side.
struct Timing {
    std::vector<double> cpu, wall;
    std::optional<double> instructions{};  // per item, of one run; nothing where they cannot be counted
};

// threads: with one, cpu is the calling thread's, else the process's. repetitions: rounds that count, >= 1.
std::vector<Timing> take_turns(const std::vector<Contestant>& contestants, unsigned repetitions, unsigned threads);

// Keeps the compiler from leaving out the computation of what is never looked at.
template <class T>
void keep(const T& value)
{
    asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace lancer::bench
