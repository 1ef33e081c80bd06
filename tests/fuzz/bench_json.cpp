// Results of benchmarks.
#include "fuzz/input.h"
#include "report/bench/results.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    fuzz::reads([&] {
        const BenchFile file = read_bench("bench.json", std::string(fuzz::as_text(data, size)));
        for (const BenchRow& row : file.rows) row.mega_per_second(), row.speed_ratio();
    });
    return 0;
}
