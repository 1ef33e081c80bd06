// Parallel parsing of large OBJ files: the text is divided at line ends, all threads parse parts, and the parts are
// passed to the builder in order. Only the plain form of common statements is supported; anything else (a continued
// line, a comment behind numbers, an index out of range, a colour) is left to obj_scan and its parser, which report
// errors. Numbers are rounded correctly and may differ in the last bit of a double from those of that parser.
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
    // Counts the statements of the text, which must outlive the result. chunk: approximate bytes of a part. Nothing if
    // the text needs the other parser.
    static std::optional<ObjChunks> survey(std::string_view text, size_t chunk);

    // As from scan_obj().
    const ObjSummary& summary() const { return summary_; }
    void set_smoothing(const Smoothing& smoothing) { summary_.smoothing = smoothing; }

    // Passes all statements to a new builder. done(bytes): the beginning of the text that is not needed any more.
    // Returns false if the text needs the other parser; the builder is then unusable.
    bool feed(ObjMeshBuilder& builder, const std::function<void(std::string_view)>& done) const;

private:
    struct Part {
        std::string_view text;
        uint64_t vertices = 0, texcoords = 0, normals = 0;  // number of each before the part
        uint32_t lines = 0;
    };

    std::vector<Part> parts_;
    ObjSummary summary_;
};

}  // namespace lancer
