// Interprets the statements of an MTL material. The keys that are given decide; see the table in docs/scene-format.md,
// "Materials of an OBJ file".
#pragma once

#include <cstdint>
#include <string>

#include "io/file_finder.h"
#include "io/mtl/scan.h"
#include "scene/description/description.h"

namespace lancer {

// The state while the materials of a file are described.
struct MtlFile {
    std::string path;
    FileFinder finder;  // of the textures it names
};

// Describes a material. A missing texture gives a warning, and the number beside it is used alone.
MaterialDescription describe_mtl(const MtlEntry& entry, MtlFile& file, Diagnostics& diagnostics);

}  // namespace lancer
