#include "harness/machine.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>

#include "app/system_info.h"
#include "app/version.h"
#include "core/parallel.h"
#include "geometry/embree/embree.h"
#include "harness/bare_embree.h"

namespace lancer::bench {
namespace {

std::string now_text()
{
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    gmtime_r(&now, &utc);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text.data();
}

}  // namespace

Json machine_context(const std::string& executable, unsigned threads)
{
    std::array<double, 3> load{};
    if (getloadavg(load.data(), 3) < 0) load = {};
    return {{"date", now_text()},
            {"cpu", cpu_model()},
            {"num_cpus", available_threads()},
            {"threads", threads},
            {"load_avg", load},
            {"compiler", compiler_text()},
            {"flags", LANCER_FLAGS},
            {"embree", embree_version()},
            {"embree_isa", "avx2"},
            {"embree_widest_isa", widest_isa()},
            {"embree_asserts", embree_has_asserts()},
            {"tbb", parallel_version()},
            {"executable", executable},
            {"lancer", LANCER_VERSION}};
}

}  // namespace lancer::bench
