// The lines of large OBJ files, and what they say, as far as most files go; see obj/chunks.h.
#pragma once

#include <array>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "io/obj/mesh.h"
#include "io/obj/scan.h"
#include "io/text_file.h"

namespace lancer {

// A line without its end, and without blanks in front.
class ObjLines {
public:
    explicit ObjLines(std::string_view text) : position_(text.data()), end_(text.data() + text.size()) {}
    bool next(std::string_view& line)
    {
        if (position_ == end_) return false;
        const auto* stop =
            static_cast<const char*>(std::memchr(position_, '\n', static_cast<size_t>(end_ - position_)));
        const char* last = stop ? stop : end_;
        const char* first = position_;
        position_ = stop ? stop + 1 : end_;
        if (last != first && last[-1] == '\r') --last;
        while (first != last && is_blank(*first)) ++first;
        line = {first, static_cast<size_t>(last - first)};
        return true;
    }

private:
    const char *position_, *end_;
};

enum class ObjWord { vertex, normal, texcoord, face, smoothing, other };

// Takes the first word off a line; of others, smoothing among them, nothing.
inline ObjWord take_kind(std::string_view& line)
{
    const auto follows = [&](size_t at) { return line.size() > at && is_blank(line[at]); };
    const auto take = [&](size_t n, ObjWord word) {
        line.remove_prefix(n);
        return word;
    };
    if (line.empty()) return ObjWord::other;
    if (line[0] == 'f' && follows(1)) return take(1, ObjWord::face);
    if (line[0] != 'v') return ObjWord::other;
    if (follows(1)) return take(1, ObjWord::vertex);
    if (line.size() > 1 && line[1] == 'n' && follows(2)) return take(2, ObjWord::normal);
    if (line.size() > 1 && line[1] == 't' && follows(2)) return take(2, ObjWord::texcoord);
    return ObjWord::other;
}

// The statements of a part, parsed.
struct ObjStatements {
    struct Run {
        ObjWord kind;
        uint32_t count;  // of a material: its index; of smoothing: the group
    };
    std::vector<Run> runs;
    std::vector<Vec3d> vertices, normals;
    std::vector<std::array<double, 2>> uvs;
    std::vector<uint32_t> sizes;  // of the faces
    std::vector<ObjCorner> corners;

    void clear() { runs.clear(), vertices.clear(), normals.clear(), uvs.clear(), sizes.clear(), corners.clear(); }
    void count(ObjWord kind)
    {
        if (runs.empty() || runs.back().kind != kind) runs.push_back({kind, 0});
        ++runs.back().count;
    }
    void hand_to(ObjMeshBuilder& builder) const;
};

// Parses a part of a file. So many vertices, texture coordinates and normals come before it. False if something needs a
// closer look.
bool parse_part(std::string_view text, const ObjSummary& summary, uint64_t vertices, uint64_t texcoords,
                uint64_t normals, ObjStatements& out);

}  // namespace lancer
