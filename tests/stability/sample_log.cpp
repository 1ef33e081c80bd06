#include "stability/sample_log.h"

#include <cinttypes>
#include <cstdio>
#include <ctime>
#include <sstream>

#include "io/atomic_file.h"
#include "io/temp_folder.h"
#include "report/page/number_text.h"

namespace lancer::stability {
namespace {

constexpr const char* head =
    "when,tier,passed,failed,samples,dropped,all_samples,all_dropped,chance_below_with_95_percent";

std::string now()
{
    const std::time_t t = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&t, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

// Of all lines of a log.
SampleCount count_lines(const std::string& log)
{
    SampleCount all;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        uint64_t samples = 0, dropped = 0;
        if (std::sscanf(line.c_str(), "%*[^,],%*[A-C],%*u,%*u,%" SCNu64 ",%" SCNu64, &samples, &dropped) == 2)
            all += {samples, dropped};
    }
    return all;
}

}  // namespace

SampleCount append_to_log(const std::string& path, const std::vector<Result>& results, const std::string& tier)
{
    std::string log = read_bytes(path);
    if (log.empty()) log = std::string(head) + "\n";
    size_t passed = 0, failed = 0;
    for (const Result& r : results)
        if (r.judged) ++(r.passes() ? passed : failed);
    const SampleCount here = count_samples(results);
    SampleCount all = count_lines(log);
    all += here;
    std::ostringstream line;
    line << now() << ',' << tier << ',' << passed << ',' << failed << ',' << here.samples << ',' << here.dropped << ','
         << all.samples << ',' << all.dropped << ',';
    if (const auto bound = here.chance_below()) line << *bound;
    write_text(path, log + line.str() + "\n");
    return all;
}

}  // namespace lancer::stability
