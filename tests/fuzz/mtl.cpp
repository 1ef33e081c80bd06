// MTL files: all their materials are described.
#include "fuzz/input.h"
#include "io/asset_path.h"
#include "io/mtl/library.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const std::string file = "/proc/a.mtl";  // no textures are there
    static const AssetFolder assets(file, "");
    const std::string_view text = fuzz::as_text(data, size);
    Diagnostics diagnostics, unheard;
    MaterialLibrary library;
    library.add_file(file, text, &assets, diagnostics);
    for (const MtlEntry& entry : scan_mtl(text, file, unheard))
        fuzz::require(library.describe(entry.name, diagnostics).has_value());
    fuzz::require(!diagnostics.has_errors());
    return 0;
}
