// Options that the header of a picture gives, which lancer verify reads behind the name of the scene, and those of a
// study file, which begin at once.
#include "app/options/option_values.h"
#include "app/options/options.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const std::string_view text = fuzz::as_text(data, size);
    std::vector<std::string> words = words_of(std::string(text));
    fuzz::reads([&] {
        if (text.starts_with('-'))
            check_study_options(words);
        else
            parse_picture_options(std::move(words));
    });
    return 0;
}
