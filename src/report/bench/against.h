// A run of `lancer bench` against an earlier one of the same mesh and the same kinds of rays.
#pragma once

#include <string>
#include <vector>

#include "report/bench/run.h"

namespace lancer {

// A figure that both runs have.
struct AgainstCell {
    const BenchFigure* now = nullptr;
    Ranged before;  // the earlier ratio to the baseline
    Ranged
        quotient;  // of the ratio now to the earlier one, the widest that both intervals allow: above 1 is faster now
    double absolute = 0;   // the same of speeds as such, which also differ by what else the machine did
    bool judged = false;   // both have intervals
    bool differs = false;  // the intervals have nothing in common
    bool is_close() const { return quotient.value <= 1.05 && quotient.value >= 1 / 1.05; }
};

struct BenchAgainst {
    std::string earlier;               // its name
    std::vector<AgainstCell> cells;    // of the ratios; pointers into the run
    std::vector<std::string> remarks;  // why the runs are not quite comparable, and answers that changed

    size_t differing() const;
    size_t close() const;  // within 5 %
};

// Writes the quotients into the figures of the run that was compared, for its files.
void annotate(BenchRun& now, const BenchAgainst& against);

// now must outlive the result. earlier: the name of the other run. Throws Error (invalid_input) at that for another
// mesh or other kinds of rays.
BenchAgainst compare(const BenchRun& now, const BenchRun& before, const std::string& earlier);

}  // namespace lancer
