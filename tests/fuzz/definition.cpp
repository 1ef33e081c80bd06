// Values that the command line, or the header of a picture, puts over those of a scene: one a line, KEY=VALUE.
#include "fuzz/input.h"
#include "io/scene/scene_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    SceneFileOptions options;
    for (std::string_view rest = fuzz::as_text(data, size); !rest.empty();) {
        const size_t end = std::min(rest.find('\n'), rest.size());
        options.definitions.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    fuzz::reads([&] {
        Diagnostics diagnostics;
        parse_scene("version = 1\n[camera]\nfov = 30\n[[light]]\n", "/proc/a.toml", options, diagnostics);
    });
    return 0;
}
