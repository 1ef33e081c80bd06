// Information of the operating system on this process and its machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lancer {

std::string cpu_model();               // "unknown" where the system does not say
std::optional<double> load_average();  // over one minute; nothing if not known
uint64_t peak_memory_bytes();
uint64_t resident_bytes();  // of this process now; 0 if not known
uint64_t memory_bytes();    // of the machine, or less where a control group allows less

double wall_seconds();  // since some fixed moment
double cpu_seconds();   // of all threads of this process so far

}  // namespace lancer
