// What a measurement was taken on, as the "context" of the files of the bench programs.
#pragma once

#include <string>

#include "harness/report.h"

namespace lancer::bench {

// executable: the path of the program.
Json machine_context(const std::string& executable, unsigned threads);

}  // namespace lancer::bench
