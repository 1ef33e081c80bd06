#include "io/obj_chunks.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "io/text_file.h"

namespace lancer {
namespace {

// A line without its end, and without blanks in front.
class Lines {
public:
    explicit Lines(std::string_view text) : position_(text.data()), end_(text.data() + text.size()) {}
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

enum class Word { vertex, normal, texcoord, face, other };

// Takes the first word off a line; of others nothing.
Word take_kind(std::string_view& line)
{
    const auto follows = [&](size_t at) { return line.size() > at && is_blank(line[at]); };
    const auto take = [&](size_t n, Word word) {
        line.remove_prefix(n);
        return word;
    };
    if (line.empty()) return Word::other;
    if (line[0] == 'f' && follows(1)) return take(1, Word::face);
    if (line[0] != 'v') return Word::other;
    if (follows(1)) return take(1, Word::vertex);
    if (line.size() > 1 && line[1] == 'n' && follows(2)) return take(2, Word::normal);
    if (line.size() > 1 && line[1] == 't' && follows(2)) return take(2, Word::texcoord);
    return Word::other;
}

// What a part holds, by a look at the first letters of its lines.
struct Contents {
    bool is_plain = true;
    uint64_t vertices = 0, texcoords = 0, normals = 0, faces = 0, triangles = 0;
    uint32_t lines = 0;
    bool face_normals = false;
    std::vector<ObjSummary::Name> materials, libraries;  // lines: in the part

    explicit Contents(std::string_view text);

private:
    void look_at_face(std::string_view corners);
    void look_at_other(std::string_view line);
    static void add(std::vector<ObjSummary::Name>& names, std::string_view name, uint32_t line, uint64_t count = 1);
};

Contents::Contents(std::string_view text)
{
    // As a line end of its own.
    for (size_t at = text.find('\r'); at != std::string_view::npos; at = text.find('\r', at + 1))
        if (at + 1 == text.size() || text[at + 1] != '\n') is_plain = false;
    Lines all(text);
    for (std::string_view line; is_plain && all.next(line);) {
        ++lines;
        if (!line.empty() && line.back() == '\\') is_plain = false;
        switch (take_kind(line)) {
            case Word::vertex:
                ++vertices;
                break;
            case Word::normal:
                ++normals;
                break;
            case Word::texcoord:
                ++texcoords;
                break;
            case Word::face:
                look_at_face(line);
                break;
            case Word::other:
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
        add(materials, s.arguments, lines);
    else if (s.kind == ObjStatement::library)
        add(libraries, s.arguments, lines);
    else
        is_plain = false;
}

void Contents::add(std::vector<ObjSummary::Name>& names, std::string_view name, uint32_t line, uint64_t count)
{
    const auto found =
        std::find_if(names.begin(), names.end(), [&](const ObjSummary::Name& n) { return n.name == name; });
    if (found != names.end())
        found->count += count;
    else
        names.push_back({std::string(name), line, count});
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

// The statements of a part, parsed.
struct Parsed {
    struct Run {
        Word kind;
        uint32_t count;  // of a material: its index
    };
    std::vector<Run> runs;
    std::vector<Vec3d> vertices, normals;
    std::vector<std::array<double, 2>> uvs;
    std::vector<uint32_t> sizes;  // of the faces
    std::vector<ObjCorner> corners;

    void clear() { runs.clear(), vertices.clear(), normals.clear(), uvs.clear(), sizes.clear(), corners.clear(); }
    void count(Word kind)
    {
        if (runs.empty() || runs.back().kind != kind) runs.push_back({kind, 0});
        ++runs.back().count;
    }
    void hand_to(ObjMeshBuilder& builder) const;
};

void Parsed::hand_to(ObjMeshBuilder& builder) const
{
    size_t vertex = 0, normal = 0, uv = 0, face = 0, corner = 0;
    for (const Run& run : runs) {
        if (run.kind == Word::other) {
            builder.use_material(run.count);
            continue;
        }
        for (uint32_t i = 0; i < run.count; ++i) switch (run.kind) {
                case Word::vertex:
                    builder.add_vertex(vertices[vertex++]);
                    break;
                case Word::normal:
                    builder.add_normal(normals[normal++]);
                    break;
                case Word::texcoord:
                    if (builder.keeps_uvs()) builder.add_uv(uvs[uv][0], uvs[uv][1]);
                    ++uv;
                    break;
                default:
                    builder.add_face(std::span(corners).subspan(corner, sizes[face]));
                    corner += sizes[face++];
            }
    }
}

// Parses one part. so_far: numbers of elements before it.
class Parser {
public:
    Parser(const ObjSummary& summary, uint64_t vertices, uint64_t texcoords, uint64_t normals, Parsed& out)
        : summary_(summary), vertices_(vertices), texcoords_(texcoords), normals_(normals), out_(out)
    {
    }
    // False if something needs a closer look.
    bool parse(std::string_view text)
    {
        out_.clear();
        Lines lines(text);
        for (std::string_view line; lines.next(line);)
            if (!parse_line(line)) return false;
        return true;
    }

private:
    bool parse_line(std::string_view line)
    {
        const Word kind = take_kind(line);
        p_ = line.data(), end_ = line.data() + line.size();
        Vec3d v;
        switch (kind) {
            case Word::vertex:
                ++vertices_;
                if (!take(v.x) || !take(v.y) || !take(v.z) || !has_at_most_a_weight()) return false;
                out_.vertices.push_back(v);
                break;
            case Word::normal:
                ++normals_;
                if (!take(v.x) || !take(v.y) || !take(v.z)) return false;
                out_.normals.push_back(v);
                break;
            case Word::texcoord:
                ++texcoords_;
                if (!take(v.x)) return false;
                if (!is_at_end() && !take(v.y)) return false;
                out_.uvs.push_back({v.x, v.y});
                break;
            case Word::face:
                if (!take_face()) return false;
                break;
            case Word::other: {
                const ObjStatementText s = parse_statement(line);
                if (s.kind != ObjStatement::use_material) return true;
                out_.runs.push_back({Word::other, summary_.material_index.find(s.arguments)->second});
                return true;
            }
        }
        out_.count(kind);
        return true;
    }
    bool is_at_end()
    {
        while (p_ != end_ && is_blank(*p_)) ++p_;
        return p_ == end_;
    }
    // A finite decimal number, up to a blank.
    bool take(double& x)
    {
        if (is_at_end()) return false;
        if (*p_ == '+') ++p_;
        const auto [stop, problem] = std::from_chars(p_, end_, x);
        if (problem != std::errc() || !std::isfinite(x) || (stop != end_ && !is_blank(*stop))) return false;
        p_ = stop;
        return true;
    }
    bool has_at_most_a_weight()
    {
        if (is_at_end()) return true;
        while (p_ != end_ && !is_blank(*p_)) ++p_;
        return is_at_end();
    }
    // An index of what there is so far.
    bool take(int32_t& index, uint64_t so_far)
    {
        const auto [stop, problem] = std::from_chars(p_, end_, index);
        p_ = stop;
        const uint64_t distance = index < 0 ? -static_cast<int64_t>(index) : index;
        return problem == std::errc() && distance != 0 && distance <= so_far;
    }
    // i, i/j, i//k or i/j/k
    bool take_corner(ObjCorner& c)
    {
        if (!take(c.vertex, vertices_)) return false;
        if (p_ == end_ || *p_ != '/') return true;
        ++p_;
        if (p_ != end_ && *p_ != '/' && !take(c.texcoord, texcoords_)) return false;
        if (p_ == end_ || *p_ != '/') return c.texcoord != 0;
        ++p_;
        return take(c.normal, normals_);
    }
    bool take_face()
    {
        uint32_t size = 0;
        for (; !is_at_end(); ++size) {
            ObjCorner c;
            if (!take_corner(c) || (p_ != end_ && !is_blank(*p_))) return false;
            out_.corners.push_back(c);
        }
        out_.sizes.push_back(size);
        return size >= 3;
    }

    const ObjSummary& summary_;
    uint64_t vertices_, texcoords_, normals_;
    Parsed& out_;
    const char *p_ = nullptr, *end_ = nullptr;
};

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
        all.parts_.push_back({parts[i], s.vertices, s.texcoords, s.normals});
        s.vertices += c.vertices, s.texcoords += c.texcoords, s.normals += c.normals;
        s.faces += c.faces, s.triangles += c.triangles;
        s.face_normals = s.face_normals || c.face_normals;
        for (const ObjSummary::Name& n : c.materials) {
            const auto [at, fresh] = s.material_index.try_emplace(n.name, static_cast<uint32_t>(s.materials.size()));
            if (fresh)
                s.materials.push_back({n.name, lines + n.line, n.count});
            else
                s.materials[at->second].count += n.count;
        }
        for (const ObjSummary::Name& n : c.libraries) {
            const auto same = [&](const ObjSummary::Name& l) { return l.name == n.name; };
            const auto found = std::find_if(s.libraries.begin(), s.libraries.end(), same);
            if (found == s.libraries.end())
                s.libraries.push_back({n.name, lines + n.line, n.count});
            else
                found->count += n.count;
        }
        lines += c.lines;
    }
    constexpr ObjLimits limits;
    const bool fits = std::max({s.vertices, s.texcoords, s.normals}) <= limits.vertices && s.triangles > 0 &&
                      s.triangles <= limits.triangles && s.libraries.size() <= limits.libraries;
    return fits ? std::optional(std::move(all)) : std::nullopt;
}

bool ObjChunks::feed(ObjMeshBuilder& builder) const
{
    // One thread builds of some parts what they say, while the others parse the next ones.
    constexpr size_t ahead = 8;
    std::array<std::vector<Parsed>, 2> parsed{std::vector<Parsed>(ahead), std::vector<Parsed>(ahead)};
    std::atomic<bool> is_plain{true};
    size_t ready = 0;  // parts in `now`
    for (size_t first = 0, round = 0; first < parts_.size() || ready > 0; ++round) {
        auto &now = parsed[round % 2], &next = parsed[1 - round % 2];
        const size_t count = std::min(ahead, parts_.size() - first);
        parallel_for(count + 1, [&](size_t i) {
            if (i == 0) {
                for (size_t k = 0; k < ready; ++k) now[k].hand_to(builder);
                return;
            }
            const Part& part = parts_[first + i - 1];
            if (!Parser(summary_, part.vertices, part.texcoords, part.normals, next[i - 1]).parse(part.text))
                is_plain = false;
        });
        if (!is_plain) return false;
        ready = count, first += count;
    }
    return true;
}

}  // namespace lancer
