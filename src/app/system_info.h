// What the operating system knows of this process and its machine.
#pragma once

#include <cstdint>
#include <string>

namespace lancer {

std::string cpu_model();  // "unknown" where the system does not say
double load_average();    // over one minute
uint64_t peak_memory_bytes();

double wall_seconds();  // since some fixed moment
double cpu_seconds();   // of all threads of this process so far

}  // namespace lancer
