// The part of the benchmark page about growth: speed, build time and memory against triangles, lights and instances,
// and the exponents that were fitted to them.
#pragma once

#include <vector>

#include "report/bench/results.h"
#include "report/page/document.h"

namespace lancer {

// Of the family "scaling"; empty where there are no such rows.
std::vector<Section> scaling_sections(const std::vector<BenchFile>& files);

}  // namespace lancer
