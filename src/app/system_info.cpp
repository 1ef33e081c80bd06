#include "app/system_info.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>

namespace lancer {

std::string cpu_model()
{
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);) {
        const size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

std::optional<double> load_average()
{
    double load = 0;
    return getloadavg(&load, 1) == 1 ? std::optional(load) : std::nullopt;
}

namespace {

// The number at the beginning of a file; nothing if there is none, such as "max".
std::optional<uint64_t> number_in(const std::string& path)
{
    std::ifstream in(path);
    uint64_t number = 0;
    return in >> number ? std::optional(number) : std::nullopt;
}

// The least limit of the control group of this process and those around it. The names of the second version of cgroups
// and of the first, whose lines list controllers.
uint64_t cgroup_limit()
{
    uint64_t least = UINT64_MAX;
    std::ifstream in("/proc/self/cgroup");
    for (std::string line; std::getline(in, line);) {
        const size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const bool is_second = controllers.empty();
        if (!is_second && ("," + controllers + ",").find(",memory,") == std::string::npos) continue;
        const std::string root = is_second ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
        const std::string name = is_second ? "/memory.max" : "/memory.limit_in_bytes";
        for (std::string group = line.substr(second + 1);; group.erase(group.rfind('/'))) {
            least = std::min(least, number_in(root + group + name).value_or(UINT64_MAX));
            if (group.find('/') == std::string::npos) break;
        }
    }
    return least;
}

}  // namespace

uint64_t memory_bytes()
{
    const auto pages = static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES));
    return std::min(cgroup_limit(), pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE)));
}

uint64_t peak_memory_bytes()
{
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

uint64_t resident_bytes()
{
    std::ifstream in("/proc/self/statm");
    uint64_t all = 0, resident = 0;
    in >> all >> resident;
    return in ? resident * static_cast<uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

double wall_seconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds()
{
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace lancer
