// What the statements of an MTL material mean together. Which keys were given decides; docs/scene-format.md, "Materials
// of an OBJ file", has the table.
#pragma once

#include <cstdint>
#include <string>

#include "io/file_finder.h"
#include "io/mtl/scan.h"
#include "scene/description/description.h"

namespace lancer {

// A material file while its materials are described.
struct MtlFile {
    std::string path;
    FileFinder finder;              // of the textures it names
    uint64_t missing_textures = 0;  // warned about so far
};

// A texture that is not there becomes a warning, and the number beside it stands alone.
MaterialDescription describe_mtl(const MtlEntry& entry, MtlFile& file, Diagnostics& diagnostics);

}  // namespace lancer
