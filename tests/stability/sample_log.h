// What all full runs of the matrix so far say of samples that are not finite: a line of CSV for each run.
#pragma once

#include <string>
#include <vector>

#include "stability/results.h"

namespace lancer::stability {

// Appends a line: when, tier, rows that passed and failed, samples and dropped ones of this run and of all runs in the
// log, and the bound on the chance of a drop that this run gives: runs of one build have the same seeds, so that many
// say no more than one. Returns the counts of all runs. Lines that are not of that form count for nothing. Throws Error
// (failed) if the file cannot be written.
SampleCount append_to_log(const std::string& path, const std::vector<Result>& results, const std::string& tier);

}  // namespace lancer::stability
