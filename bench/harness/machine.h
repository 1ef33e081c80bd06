// What a measurement was taken on: two of them are comparable only if this agrees.
#pragma once

#include <string>

#include "harness/report.h"

namespace lancer::bench {

// The "context" of the files: CPU, load, compiler and its flags, libraries as loaded, what Embree runs on.
// executable: the path of the program.
Json machine_context(const std::string& executable, unsigned threads);

}  // namespace lancer::bench
