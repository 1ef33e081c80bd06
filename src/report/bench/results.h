// What benchmarks measured, as their files have it: JSON in the shape of Google Benchmark's, with a machine block as
// "context" and one row for each figure. The bench programs and `lancer bench` write them; docs/benchmarks.md says what
// the fields mean.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/bench/comparable.h"
#include "report/page/svg_plot.h"

namespace lancer {

// The members of a JSON object that are neither lists nor objects.
struct BenchFields {
    std::vector<std::pair<std::string, double>> numbers{};
    std::vector<std::pair<std::string, std::string>> texts{};  // and yes and no

    std::optional<double> number(const std::string& key) const;
    std::string text(const std::string& key) const;  // empty if there is none
};

struct BenchRow : BenchFields {
    std::string name{}, family{}, mesh{}, accel{}, rays{}, way{};  // empty where they say nothing

    // Items per second, in millions, with the range of the rounds. NaN where the row was not timed.
    Ranged mega_per_second() const;
    // How much faster than what `ratio_to` names, with the range of the rounds.
    std::optional<Ratio> speed_ratio() const;
};

struct BenchFile {
    std::string name;
    MachineBlock machine;
    BenchFields context;  // what else the context says
    std::vector<BenchRow> rows;
    std::string json;  // as it was read
};

// name: for messages. Throws Error (invalid_input) if the text is not JSON, not of this shape, or has no row.
BenchFile read_bench(const std::string& name, const std::string& json);

// The text of such a file. context: what it says besides the machine, such as what was measured.
std::string to_json(const MachineBlock& machine, const BenchFields& context, const std::vector<BenchRow>& rows);
// The machine block alone: the value of "context".
std::string context_json(const MachineBlock& machine);

// Rows as CSV, a column for each name that some row has, in the order in which they turn up.
using NamedFields = std::vector<std::pair<std::string, std::string>>;
std::string named_csv(const std::vector<NamedFields>& rows);

using BenchRows = std::vector<const BenchRow*>;

// The rows of a family, in their order; all rows for "".
BenchRows rows_of(const std::vector<BenchFile>& files, const std::string& family);

// The different values of a member, in the order in which they turn up; empty ones are left out.
std::vector<std::string> distinct(const BenchRows& rows, std::string BenchRow::*member);

// Those that have this value there.
BenchRows where(const BenchRows& rows, std::string BenchRow::*member, const std::string& value);

}  // namespace lancer
