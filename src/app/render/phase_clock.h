// How long the phases of a run take, and how much memory.
#pragma once

#include <algorithm>
#include <type_traits>

#include "app/system_info.h"
#include "report/stats_json.h"

namespace lancer {

// Adds what the phase took to the figures when the next begins, and at its end.
class PhaseClock {
public:
    PhaseClock(RunStats& stats, const char* phase) : stats_(stats), phase_(phase) {}
    ~PhaseClock() { end(); }
    PhaseClock(const PhaseClock&) = delete;
    PhaseClock& operator=(const PhaseClock&) = delete;

    void next(const char* phase)
    {
        end();
        phase_ = phase, wall_ = wall_seconds(), cpu_ = cpu_seconds();
    }

private:
    void end()
    {
        const uint64_t resident = resident_bytes();
        // The system counts both a little late, not alike.
        const uint64_t peak = std::max(resident, peak_memory_bytes());
        stats_.phases.push_back({phase_, wall_seconds() - wall_, cpu_seconds() - cpu_, resident, peak});
    }

    RunStats& stats_;
    const char* phase_;
    double wall_ = wall_seconds(), cpu_ = cpu_seconds();
};

// The result of f, which is a phase; f may take the clock, for further ones.
template <class F>
auto timed(RunStats& stats, const char* phase, F&& f)
{
    PhaseClock clock(stats, phase);
    if constexpr (std::is_invocable_v<F, PhaseClock&>)
        return f(clock);
    else
        return f();
}

}  // namespace lancer
