#include "harness/timing.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "harness/instructions.h"

namespace lancer::bench {

std::vector<Timing> take_turns(const std::vector<Contestant>& contestants, unsigned repetitions, unsigned threads)
{
    const auto cpu_ns = [&] { return threads == 1 ? thread_ns() : all_ns(); };
    const auto run = [&](const Contestant& c, Timing& t) {
        if (c.timed) {
            const double ns = c.timed();
            t.cpu.push_back(ns / c.items), t.wall.push_back(ns / c.items);
            return;
        }
        const double cpu = cpu_ns(), wall = wall_ns();
        c.run();
        t.wall.push_back((wall_ns() - wall) / c.items);
        t.cpu.push_back((cpu_ns() - cpu) / c.items);
    };
    std::vector<Timing> timings(contestants.size()), unheard(contestants.size());
    for (size_t i = 0; i < contestants.size(); ++i) run(contestants[i], unheard[i]);
    if (threads == 1)
        for (size_t i = 0; i < contestants.size(); ++i)
            if (contestants[i].run)
                if (const auto count = instructions_of(contestants[i].run))
                    timings[i].instructions = *count / contestants[i].items;
    // By chance, as who runs after whom tells in the caches.
    std::vector<size_t> order(contestants.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::mt19937_64 random(1);
    for (unsigned round = 0; round < repetitions; ++round) {
        std::shuffle(order.begin(), order.end(), random);
        for (const size_t i : order) run(contestants[i], timings[i]);
    }
    return timings;
}

}  // namespace lancer::bench
