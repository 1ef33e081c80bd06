// What a measurement was taken on: two of them are comparable only if this agrees.
#pragma once

#include <string>

#include "report/bench/comparable.h"

namespace lancer {

// CPU, load, compiler and its flags, libraries as loaded, what Embree runs on. executable: the path of the program.
// isa: what Embree is limited to.
MachineBlock measure_machine(const std::string& executable, unsigned threads, const std::string& isa);

}  // namespace lancer
