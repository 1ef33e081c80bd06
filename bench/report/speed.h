// The parts of the benchmark page about speed: how accelerators compare at a glance, each mesh with every kind of ray
// and the wrong answers beside each speed, and what building costs.
#pragma once

#include <vector>

#include "report/bench/results.h"
#include "report/page/document.h"

namespace lancer {

// Empty where there are no rows of the family "accel".
std::vector<Section> speed_sections(const std::vector<BenchFile>& files);

// Of the family "build".
std::vector<Section> build_sections(const std::vector<BenchFile>& files);

}  // namespace lancer
