// The real program, with what it took.
#pragma once

#include <algorithm>

#include "app/run_program.h"
#include "stability/row.h"
#include "support/sanitized.h"

namespace lancer::stability {

struct MeasuredRun {
    Said said;
    double cpu_seconds = 0, wall_seconds = 0;
    double peak_mb = 0;  // of resident memory, MiB, as looked at every millisecond
};

// No other program may end meanwhile: the time is that of all children.
MeasuredRun measured_run(const TempFolder& folder, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment = {});

// Of time or memory of a run: only told where a sanitizer takes many times as much.
inline Measure cost_at_most(std::string what, double value, double threshold)
{
    return is_sanitized ? told(std::move(what), value) : at_most(std::move(what), value, threshold);
}

}  // namespace lancer::stability
