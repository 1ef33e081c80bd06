// Whether one run of the benchmarks confirms another: the same ratios, within what their rounds leave open.
#pragma once

#include <vector>

#include "report/bench/results.h"
#include "report/page/document.h"

namespace lancer {

struct RepeatedRow {
    std::string name, family;
    Ratio first, second;
    double quotient() const { return second.value / first.value; }
    bool agrees() const { return repeats(first, second); }
};

// Rows of the same name that have a ratio in both, in the order of the first.
std::vector<RepeatedRow> repeated_rows(const std::vector<BenchFile>& first, const std::vector<BenchFile>& second);

// What not_comparable() says of the files of each program in both.
std::vector<std::string> comparison_reasons(const std::vector<BenchFile>& first, const std::vector<BenchFile>& second);

Section repeat_section(const std::vector<BenchFile>& first, const std::vector<BenchFile>& second);

}  // namespace lancer
