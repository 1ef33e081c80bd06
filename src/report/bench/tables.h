// The figures of a run as tables.
#pragma once

#include <string>
#include <vector>

#include "report/bench/against.h"
#include "report/page/document.h"

namespace lancer {

// A row for each thing that was measured, a column for each method; with intervals, cells have three lines, the last of
// which is the interval of the ratio.
Table figures_table(const BenchRun& run, bool intervals);

// What was measured, and on what: pairs of a name and what is told.
Table run_table(const BenchRun& run);

// Ratios that differ beyond both intervals, and, with `all`, those that do not.
Table against_table(const BenchAgainst& against, bool all);
// How many ratios agree.
std::string verdict_of(const BenchAgainst& against);

}  // namespace lancer
