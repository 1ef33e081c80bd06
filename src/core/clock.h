// Clocks in nanoseconds, for measurements.
#pragma once

namespace lancer {

double wall_ns();    // since some fixed moment
double thread_ns();  // of CPU, of the calling thread
double all_ns();     // of CPU, of all threads of the process

}  // namespace lancer
