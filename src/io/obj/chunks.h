// OBJ files so large that one thread takes long over them: cut at line ends, the parts parsed by all threads and handed
// to the builder in the order of the file. Only what most of such files hold is understood here, in its plain form:
// anything else (a continued line, a comment behind numbers, an index out of range, a colour) is left to obj_scan and
// the parser behind it, which say what is wrong and where. Numbers are rounded correctly, so that they may differ in
// the last bit of a double from those of that parser.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "io/obj/mesh.h"
#include "io/obj/scan.h"

namespace lancer {

class ObjChunks {
public:
    // Counts what is in the text, which must live as long. chunk: bytes of a part, about. Nothing if something needs a
    // closer look.
    static std::optional<ObjChunks> survey(std::string_view text, size_t chunk);

    // As scan_obj() has it.
    const ObjSummary& summary() const { return summary_; }

    // All statements into a fresh builder. done: told how much of the text, from its begin, is not needed any more.
    // False if something needs a closer look; the builder is then of no use any more.
    bool feed(ObjMeshBuilder& builder, const std::function<void(std::string_view)>& done) const;

private:
    struct Part {
        std::string_view text;
        uint64_t vertices = 0, texcoords = 0, normals = 0;  // that come before
        uint32_t lines = 0;
    };

    std::vector<Part> parts_;
    ObjSummary summary_;
};

}  // namespace lancer
