#include "harness/machine.h"

#include "app/bench/machine.h"
#include "report/bench/results.h"

namespace lancer::bench {

Json machine_context(const std::string& executable, unsigned threads)
{
    return Json::parse(context_json(measure_machine(executable, threads, "avx2")));
}

}  // namespace lancer::bench
