// The matrix as it came out: rows with their measures, as a document and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/page/document.h"
#include "stability/row.h"
#include "stability/sweep.h"

namespace lancer::stability {

struct Result {
    std::string id, stiff, reference, accelerator;  // accelerator: empty where it does not matter
    bool judged = true;   // false: of an accelerator that promises nothing; shown beside the product's
    std::string problem;  // what was thrown, if the row could not be run to its end
    Outcome outcome;
    double seconds = 0;

    bool passes() const;
};

// Samples that were taken, and those of them that were no finite numbers.
struct SampleCount {
    uint64_t samples = 0, dropped = 0;

    SampleCount& operator+=(const SampleCount& o)
    {
        samples += o.samples, dropped += o.dropped;
        return *this;
    }
    // With none of n dropped the chance of a drop is below 3/n with 95 % confidence (the rule of three); else nothing.
    std::optional<double> chance_below() const;
};
// Of the rows that are judged.
SampleCount count_samples(const std::vector<Result>& results);

// Runs a row on so many threads, unless it has its own; what it throws becomes the result's problem.
Result run_row(const Row& row, const Setup& setup, unsigned threads);

// tier: how the rows were run, "A" to "C". Sweeps become plots. all_runs: of every full run so far, if this is one.
Document make_page(const std::vector<Result>& results, const std::vector<Sweep>& sweeps, const std::string& tier,
                   const std::optional<SampleCount>& all_runs = {});
std::string to_json(const std::vector<Result>& results, const std::string& tier);

}  // namespace lancer::stability
