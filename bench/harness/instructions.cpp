#include "harness/instructions.h"

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define RUNNING_ON_VALGRIND 0
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS
#endif

namespace lancer::bench {
namespace {

// The processor's own counter, or -1.
int open_counter()
{
    perf_event_attr what{};
    what.size = sizeof what;
    what.type = PERF_TYPE_HARDWARE;
    what.config = PERF_COUNT_HW_INSTRUCTIONS;
    what.disabled = 1, what.exclude_kernel = 1, what.exclude_hv = 1;
    return static_cast<int>(syscall(SYS_perf_event_open, &what, 0, -1, -1, 0));
}

// callgrind leaves what it counted in a file, the first of a process in callgrind.out.PID.1.
std::optional<double> counted_by_valgrind(const std::function<void()>& work)
{
    static int dumps = 0;
    CALLGRIND_ZERO_STATS;
    work();
    CALLGRIND_DUMP_STATS;
    const std::string file = "callgrind.out." + std::to_string(getpid()) + "." + std::to_string(++dumps);
    std::ifstream in(file);
    std::optional<double> total;
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("totals: ")) total = std::stod(line.substr(8));
    std::remove(file.c_str());
    return total;
}

}  // namespace

bool is_under_valgrind() { return RUNNING_ON_VALGRIND != 0; }

std::optional<double> instructions_of(const std::function<void()>& work)
{
    if (is_under_valgrind()) return counted_by_valgrind(work);
    const int counter = open_counter();
    if (counter < 0) return {};
    ioctl(counter, PERF_EVENT_IOC_RESET, 0);
    ioctl(counter, PERF_EVENT_IOC_ENABLE, 0);
    work();
    ioctl(counter, PERF_EVENT_IOC_DISABLE, 0);
    uint64_t count = 0;
    const bool is_read = read(counter, &count, sizeof count) == static_cast<ssize_t>(sizeof count);
    close(counter);
    return is_read && count > 0 ? std::optional(static_cast<double>(count)) : std::nullopt;
}

}  // namespace lancer::bench
