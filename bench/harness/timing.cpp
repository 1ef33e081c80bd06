#include "harness/timing.h"

#include <ctime>

namespace lancer::bench {
namespace {

double clock_ns(clockid_t clock)
{
    timespec t{};
    clock_gettime(clock, &t);
    return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

}  // namespace

double wall_ns() { return clock_ns(CLOCK_MONOTONIC); }
double thread_ns() { return clock_ns(CLOCK_THREAD_CPUTIME_ID); }
double all_ns() { return clock_ns(CLOCK_PROCESS_CPUTIME_ID); }

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
    for (unsigned round = 0; round < repetitions; ++round)
        for (size_t k = 0; k < contestants.size(); ++k) {
            const size_t i = (k + round) % contestants.size();
            run(contestants[i], timings[i]);
        }
    return timings;
}

std::vector<double> speed_ratios(const std::vector<double>& base, const std::vector<double>& other)
{
    std::vector<double> ratios;
    for (size_t i = 0; i < base.size(); ++i) ratios.push_back(base[i] / other[i]);
    return ratios;
}

}  // namespace lancer::bench
