// Scene files, without the meshes and pictures that they name.
#include "fuzz/input.h"
#include "io/scene/scene_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    SceneFileOptions options;
    options.mesh_loader = [](const std::string&, Diagnostics&, const MeshOptions&) {
        return std::make_shared<const MeshData>();
    };
    fuzz::reads([&] {
        Diagnostics diagnostics;
        parse_scene(fuzz::as_text(data, size), "/proc/a.toml", options, diagnostics);
    });
    return 0;
}
