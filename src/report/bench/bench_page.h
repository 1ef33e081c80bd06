// The page of a run: one table of all figures, and bars with their intervals.
#pragma once

#include "report/bench/against.h"
#include "report/page/document.h"

namespace lancer {

// against: null if it was not compared.
Document make_page(const BenchRun& run, const BenchAgainst* against);

}  // namespace lancer
