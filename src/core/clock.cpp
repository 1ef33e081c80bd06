#include "core/clock.h"

#include <ctime>

namespace lancer {
namespace {

double clock_ns(clockid_t clock)
{
    timespec t{};
    clock_gettime(clock, &t);
    return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

}  // namespace

double wall_ns() { return clock_ns(CLOCK_MONOTONIC); }
double thread_ns() { return clock_ns(CLOCK_THREAD_CPUTIME_ID); }
double all_ns() { return clock_ns(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace lancer
