#include "io/obj/part.h"

#include <charconv>
#include <cmath>

#include "io/text_file.h"

namespace lancer {
namespace {

class Parser {
public:
    Parser(const ObjSummary& summary, uint64_t vertices, uint64_t texcoords, uint64_t normals, ObjStatements& out)
        : summary_(summary), vertices_(vertices), texcoords_(texcoords), normals_(normals), out_(out)
    {
    }
    // False if something needs a closer look.
    bool parse(std::string_view text)
    {
        out_.clear();
        ObjLines lines(text);
        for (std::string_view line; lines.next(line);)
            if (!parse_line(line)) return false;
        return true;
    }

private:
    bool parse_line(std::string_view line)
    {
        const ObjWord kind = take_kind(line);
        p_ = line.data(), end_ = line.data() + line.size();
        Vec3d v;
        switch (kind) {
            case ObjWord::vertex:
                ++vertices_;
                if (!take(v.x) || !take(v.y) || !take(v.z) || !has_at_most_a_weight()) return false;
                out_.vertices.push_back(v);
                break;
            case ObjWord::normal:
                ++normals_;
                if (!take(v.x) || !take(v.y) || !take(v.z)) return false;
                out_.normals.push_back(v);
                break;
            case ObjWord::texcoord:
                ++texcoords_;
                if (!take(v.x)) return false;
                if (!is_at_end() && !take(v.y)) return false;
                out_.uvs.push_back({v.x, v.y});
                break;
            case ObjWord::face:
                if (!take_face()) return false;
                break;
            case ObjWord::smoothing:
            case ObjWord::other: {
                const ObjStatementText s = parse_statement(line);
                if (s.kind == ObjStatement::smoothing && smooths(summary_))
                    out_.runs.push_back({ObjWord::smoothing, smoothing_group(s.arguments)});
                if (s.kind != ObjStatement::use_material) return true;
                out_.runs.push_back({ObjWord::other, summary_.material_index.find(s.arguments)->second});
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
    ObjStatements& out_;
    const char *p_ = nullptr, *end_ = nullptr;
};

}  // namespace

void ObjStatements::hand_to(ObjMeshBuilder& builder) const
{
    size_t vertex = 0, normal = 0, uv = 0, face = 0, corner = 0;
    for (const Run& run : runs) {
        if (run.kind == ObjWord::other) {
            builder.use_material(run.count);
            continue;
        }
        if (run.kind == ObjWord::smoothing) {
            builder.use_smoothing(run.count);
            continue;
        }
        for (uint32_t i = 0; i < run.count; ++i) switch (run.kind) {
                case ObjWord::vertex:
                    builder.add_vertex(vertices[vertex++]);
                    break;
                case ObjWord::normal:
                    builder.add_normal(normals[normal++]);
                    break;
                case ObjWord::texcoord:
                    if (builder.keeps_uvs()) builder.add_uv(uvs[uv][0], uvs[uv][1]);
                    ++uv;
                    break;
                default:
                    builder.add_face(std::span(corners).subspan(corner, sizes[face]));
                    corner += sizes[face++];
            }
    }
}

bool parse_part(std::string_view text, const ObjSummary& summary, uint64_t vertices, uint64_t texcoords,
                uint64_t normals, ObjStatements& out)
{
    return Parser(summary, vertices, texcoords, normals, out).parse(text);
}

}  // namespace lancer
