// The page of a run of the benchmarks, out of the files that its programs wrote: the machine and what may not be
// compared, speed, building, right and wrong answers, growth, the limit of a render, whole pictures, and the raw files.
#pragma once

#include <vector>

#include "report/bench/results.h"
#include "report/page/document.h"

namespace lancer {

// earlier: the files of another run to hold this one against; may be empty.
Document make_bench_page(const std::vector<BenchFile>& files, const std::vector<BenchFile>& earlier);

// Why figures of these files may not stand side by side; empty if they may. Each file is looked at by itself, and
// against the first.
std::vector<std::string> verdicts(const std::vector<BenchFile>& files);

}  // namespace lancer
