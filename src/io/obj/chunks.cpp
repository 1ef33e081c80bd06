#include "io/obj/chunks.h"

#include <algorithm>
#include <atomic>

#include "core/parallel.h"
#include "io/obj/part.h"
#include "io/text_file.h"

namespace lancer {
namespace {

// To those that there are, or as a new one.
void add(std::vector<ObjSummary::Name>& names, std::string_view name, uint32_t line, uint64_t count)
{
    const auto found =
        std::find_if(names.begin(), names.end(), [&](const ObjSummary::Name& n) { return n.name == name; });
    if (found != names.end())
        found->count += count;
    else
        names.push_back({std::string(name), line, count});
}

// What a part holds, by a look at the first letters of its lines.
struct Contents {
    bool is_plain = true;
    uint64_t vertices = 0, texcoords = 0, normals = 0, faces = 0, triangles = 0;
    uint32_t lines = 0;
    bool face_normals = false, smoothing_groups = false;
    std::vector<ObjSummary::Name> materials, libraries;  // lines: in the part

    explicit Contents(std::string_view text);

private:
    void look_at_face(std::string_view corners);
    void look_at_other(std::string_view line);
};

Contents::Contents(std::string_view text)
{
    // As a line end of its own.
    for (size_t at = text.find('\r'); at != std::string_view::npos; at = text.find('\r', at + 1))
        if (at + 1 == text.size() || text[at + 1] != '\n') is_plain = false;
    ObjLines all(text);
    for (std::string_view line; is_plain && all.next(line);) {
        ++lines;
        if (!line.empty() && line.back() == '\\') is_plain = false;
        switch (take_kind(line)) {
            case ObjWord::vertex:
                ++vertices;
                break;
            case ObjWord::normal:
                ++normals;
                break;
            case ObjWord::texcoord:
                ++texcoords;
                break;
            case ObjWord::face:
                look_at_face(line);
                break;
            case ObjWord::smoothing:
            case ObjWord::other:
                look_at_other(line);
                break;
        }
    }
}

void Contents::look_at_face(std::string_view corners)
{
    uint64_t count = 0;
    uint32_t slashes = 0;
    bool inside = false;
    for (const char c : corners) {
        const bool blank = is_blank(c);
        if (!blank && !inside) ++count, slashes = 0;
        if (c == '/') ++slashes;
        if (slashes == 2 && c != '/' && !blank) face_normals = true;
        inside = !blank;
    }
    if (count < 3 || count > ObjLimits{}.corners_of_face) is_plain = false;
    ++faces;
    triangles += count - 2;
}

void Contents::look_at_other(std::string_view line)
{
    const ObjStatementText s = parse_statement(line);
    if (s.kind == ObjStatement::ignored) return;
    if (s.kind == ObjStatement::use_material)
        add(materials, s.arguments, lines, 1);
    else if (s.kind == ObjStatement::library)
        add(libraries, s.arguments, lines, 1);
    else if (s.kind == ObjStatement::smoothing)
        smoothing_groups = smoothing_groups || smoothing_group(s.arguments) != 0;
    else
        is_plain = false;
}

std::vector<std::string_view> cut(std::string_view text, size_t chunk)
{
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const size_t stop = chunk < text.size() ? text.find('\n', chunk) : std::string_view::npos;
        parts.push_back(text.substr(0, stop == std::string_view::npos ? stop : stop + 1));
        text.remove_prefix(parts.back().size());
    }
    return parts;
}

}  // namespace

std::optional<ObjChunks> ObjChunks::survey(std::string_view text, size_t chunk)
{
    const std::vector<std::string_view> parts = cut(text, chunk);
    std::vector<std::optional<Contents>> contents(parts.size());
    parallel_for(parts.size(), [&](size_t i) { contents[i].emplace(parts[i]); });
    ObjChunks all;
    ObjSummary& s = all.summary_;
    uint32_t lines = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
        const Contents& c = *contents[i];
        if (!c.is_plain) return {};
        all.parts_.push_back({parts[i], s.vertices, s.texcoords, s.normals, lines});
        s.vertices += c.vertices, s.texcoords += c.texcoords, s.normals += c.normals;
        s.faces += c.faces, s.triangles += c.triangles;
        s.face_normals = s.face_normals || c.face_normals;
        s.smoothing_groups = s.smoothing_groups || c.smoothing_groups;
        for (const ObjSummary::Name& n : c.materials) {
            const auto [at, fresh] = s.material_index.try_emplace(n.name, static_cast<uint32_t>(s.materials.size()));
            if (fresh)
                s.materials.push_back({n.name, lines + n.line, n.count});
            else
                s.materials[at->second].count += n.count;
        }
        for (const ObjSummary::Name& n : c.libraries) add(s.libraries, n.name, lines + n.line, n.count);
        lines += c.lines;
    }
    constexpr ObjLimits limits;
    const bool fits = std::max({s.vertices, s.texcoords, s.normals}) <= limits.vertices && s.triangles > 0 &&
                      s.triangles <= limits.triangles && s.libraries.size() <= limits.libraries;
    return fits ? std::optional(std::move(all)) : std::nullopt;
}

bool ObjChunks::feed(ObjMeshBuilder& builder, const std::function<void(std::string_view)>& done) const
{
    // One thread builds of some parts what they say, while the others parse the next ones.
    constexpr size_t ahead = 8;
    std::array<std::vector<ObjStatements>, 2> parsed{std::vector<ObjStatements>(ahead),
                                                     std::vector<ObjStatements>(ahead)};
    std::atomic<bool> is_plain{true};
    size_t ready = 0;  // parts in `now`
    for (size_t first = 0, round = 0; first < parts_.size() || ready > 0; ++round) {
        auto &now = parsed[round % 2], &next = parsed[1 - round % 2];
        const size_t count = std::min(ahead, parts_.size() - first);
        parallel_for(count + 1, [&](size_t i) {
            if (i == 0) {
                for (size_t k = 0; k < ready; ++k) {
                    const Part& part = parts_[first - ready + k];
                    builder.begin_part();
                    now[k].hand_to(builder);
                    builder.end_part(part.text, part.lines);
                    const char* const begin = parts_[0].text.data();
                    done({begin, static_cast<size_t>(part.text.data() + part.text.size() - begin)});
                }
                return;
            }
            const Part& part = parts_[first + i - 1];
            if (!parse_part(part.text, summary_, part.vertices, part.texcoords, part.normals, next[i - 1]))
                is_plain = false;
        });
        if (!is_plain) return false;
        ready = count, first += count;
    }
    return true;
}

}  // namespace lancer
