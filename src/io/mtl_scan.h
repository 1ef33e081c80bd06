// Material files (MTL) before they are parsed: where they are, and which keys each material gives. The parser behind
// load_obj has no "was it given" (an absent Kd is black) and takes any text for a number.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "io/obj_scan.h"

namespace lancer {

struct MtlEntry {
    std::string name;
    uint32_t line = 0;
    size_t begin = 0;                   // of its part of MtlScan::text
    uint32_t kd_line = 0, ke_line = 0;  // 0: not given, or not usable and warned about
};

struct MtlScan {
    std::vector<MtlEntry> materials;  // in the order of the file
    std::string text;                 // the same materials for the parser: names replaced by numbers, values checked
};

MtlScan scan_mtl(std::string_view text, const std::string& file, Diagnostics& diagnostics);

// The files named by mtllib statements, each once, relative to the OBJ file. A name may contain spaces, be one of
// several, or differ in upper and lower case; what is not found becomes a warning.
std::vector<std::string> find_material_files(const std::string& obj_file,
                                             const std::vector<ObjSummary::Name>& libraries, Diagnostics& diagnostics);

}  // namespace lancer
