// Results of a study, read back; what was read is written as the same study.
#include "fuzz/input.h"
#include "report/study/json.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    fuzz::reads([&] {
        const std::string json = to_json(read_study("study.json", std::string(fuzz::as_text(data, size))));
        fuzz::require(to_json(read_study("study.json", json)) == json);
    });
    return 0;
}
