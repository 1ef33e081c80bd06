// The matrix as it came out: rows with their measures, as a document and as JSON.
#pragma once

#include <string>
#include <vector>

#include "report/document.h"
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

// Runs a row on so many threads, unless it has its own; what it throws becomes the result's problem.
Result run_row(const Row& row, const Setup& setup, unsigned threads);

// tier: how the rows were run, "A" to "C". Sweeps become plots.
Document make_page(const std::vector<Result>& results, const std::vector<Sweep>& sweeps, const std::string& tier);
std::string to_json(const std::vector<Result>& results, const std::string& tier);

}  // namespace lancer::stability
