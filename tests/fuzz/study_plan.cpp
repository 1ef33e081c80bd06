// Study files.
#include "fuzz/input.h"
#include "io/study_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const std::string& path = fuzz::as_file(fuzz::as_text(data, size));
    fuzz::reads([&] {
        Diagnostics diagnostics;
        load_study_file(path, diagnostics);
    });
    return 0;
}
