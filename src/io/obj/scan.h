// What can be known of an OBJ file before it is parsed. The parser behind load_obj trusts its input: it wraps
// indices, reads "nan" as 0 and forgets lines. So every statement it will see is checked here first, with its line,
// and reaches it in one plain form (obj/feed.h). Curves and surfaces of the format are not supported.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "io/smoothing.h"
#include "io/text_file.h"

namespace lancer {

struct ObjLimits {
    uint64_t vertices = INT32_MAX;       // the parser's indices are int
    uint64_t triangles = UINT32_MAX;     // triangles are numbered with 32 bits
    uint64_t corners_of_face = 100'000;  // cutting ears takes quadratic time
    uint64_t libraries = 1000;           // different mtllib statements: each searches a folder
};

struct ObjSummary {
    struct Name {
        std::string name;  // of a material; after mtllib one or more files; with what may be a comment behind it
        uint32_t line = 0;
        uint64_t count = 0;
    };
    uint64_t vertices = 0, normals = 0, texcoords = 0;
    uint64_t faces = 0;      // with at least one corner
    uint64_t triangles = 0;  // at most, after triangulation
    bool forward_references = false, face_normals = false;
    bool vertex_colors = false;     // some vertex has three numbers after its place
    bool smoothing_groups = false;  // some statement s names a group
    Smoothing smoothing = {};       // as the scene asks for it
    std::vector<Name> libraries, materials;
    std::map<std::string, uint32_t, std::less<>> material_index;  // into materials, by name
};

// Returns nothing after adding an error.
std::optional<ObjSummary> scan_obj(std::string_view text, const std::string& file, Diagnostics& diagnostics,
                                   const ObjLimits& limits = {});

// The line of the index-th statement v, vn, vt or f (one with corners); for messages only: it searches from the start.
enum class ObjStatement {
    vertex,
    normal,
    texcoord,
    face,
    use_material,
    library,
    smoothing,
    line_or_point,
    ignored,
    unknown
};
uint32_t line_of(std::string_view text, ObjStatement kind, uint64_t index);

// A line by its first word; of an unknown statement the arguments are that word.
struct ObjStatementText {
    ObjStatement kind;
    std::string_view arguments;
};
ObjStatementText parse_statement(std::string_view line);

// The group that the arguments of a statement s name; 0: none.
uint32_t smoothing_group(std::string_view arguments);

// Whether faces get normals: never where the file has some of its own.
inline bool smooths(const ObjSummary& s)
{
    if (s.face_normals) return false;
    return s.smoothing.faces == Smoothing::Faces::all ||
           (s.smoothing.faces == Smoothing::Faces::groups && s.smoothing_groups);
}
// Whether they do so as one group, whatever statements s say.
inline bool is_one_group(const ObjSummary& s) { return smooths(s) && !s.smoothing_groups; }

}  // namespace lancer
