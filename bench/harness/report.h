// The rows that a bench program writes: as JSON in the shape of Google Benchmark's, with the machine they were measured
// on, and as CSV beside it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/timing.h"

namespace lancer::bench {

using Json = nlohmann::ordered_json;

class Report {
public:
    // context: see machine_context().
    explicit Report(Json context) : context_(std::move(context)) {}

    // A row under "family/..."; fields are added to what is returned, which lives until the next row.
    Json& add(const std::string& family, const std::string& name);
    // The same for something that was timed. items_per_second, min and max are of the CPU with one thread and of the
    // wall with more: "clock" says which.
    Json& add(const std::string& family, const std::string& name, const Timing& timing, unsigned threads);

    // path.json: also path.csv, whatever the ending of path. Throws Error (failed).
    void write(const std::string& path) const;
    bool empty() const { return rows_.empty(); }

    // That what was measured is not as it must be: the rows are written, and the program then fails with this.
    void fail(std::string why) { failure_ = std::move(why); }
    const std::string& failure() const { return failure_; }

private:
    Json context_;
    std::vector<Json> rows_;
    std::string failure_;
};

// "a/b/c"
std::string joined(std::initializer_list<std::string> parts);

// The times by which ratios are taken: see Report::add.
const std::vector<double>& counted(const Timing& timing, unsigned threads);

// Adds the median, min and max, and the interval of 95 % of the median, of how much faster `timing` is than `base`,
// round by round.
void add_ratio(Json& row, const std::string& base_name, const Timing& base, const Timing& timing, unsigned threads);

}  // namespace lancer::bench
