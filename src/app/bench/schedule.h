// Parts of a measurement that share a time. They take turns in small steps, so that each is spread over the whole time
// and what disturbs the machine for a while disturbs all of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace lancer {

struct BenchPart {
    std::string name;
    double weight;               // its part of the time, in any unit; > 0
    std::function<void()> step;  // one round, or a piece of it
    double expected = 0;         // seconds of the first step, if known
    size_t steps = 0;            // that were done
};

// Steps until `end`: first one of each part, in their order, then always of the part that had the least time for its
// weight. A step that would end later, by how long the last one of its part took, is not begun. now: the clock,
// seconds. is_stopped: asked before each step.
void run_parts(std::vector<BenchPart>& parts, double end, const std::function<double()>& now,
               const std::function<bool()>& is_stopped);

}  // namespace lancer
