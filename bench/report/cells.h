// How figures of benchmarks become cells of tables. Used by the parts of report/page.h.
#pragma once

#include <string>
#include <vector>

#include "report/bench/results.h"
#include "report/page/document.h"

namespace lancer {

inline Cell text_cell(std::string text) { return {std::move(text)}; }
Cell number_cell(double x);  // three digits; empty for NaN
Cell number_cell(const std::optional<double>& x);
Cell count_cell(const std::optional<double>& x);  // all digits
Cell ranged_cell(const Ranged& r);                // "12.3 [12.0 .. 12.5]"

// "×1.18 [1.15 .. 1.20]"
std::string ratio_text(const Ratio& r);

// Every figure of these rows that is not about timing alone: a column for each field that some row has.
Table table_of(const BenchRows& rows, const std::string& caption);

// The first row with these values; nullptr if there is none. An empty value stands for any.
struct RowKey {
    std::string mesh, accel, rays, way;
};
const BenchRow* find_row(const BenchRows& rows, const RowKey& key);

}  // namespace lancer
