#include "io/obj/feed.h"

#include "io/obj/corner.h"

namespace lancer {
namespace {

// Without what refers to nothing, and without a slash that has no number behind it: the parser would take the next
// corner's number instead.
void assign_face(std::string& out, std::string_view corners, const ObjSummary& summary)
{
    out = 'f';
    for (std::string_view word = take_word(corners); !word.empty(); word = take_word(corners)) {
        const CornerParts parts = *split_corner(word);
        (out += ' ') += parts[0];
        const bool normal = refers(parts[2], summary.normals);
        if (refers(parts[1], summary.texcoords))
            (out += '/') += parts[1];
        else if (normal)
            out += '/';
        if (normal) (out += '/') += parts[2];
    }
}

// One that is not three finite numbers has no length: indices count it.
void assign_normal(std::string& out, std::string_view arguments)
{
    std::string_view rest = arguments;
    for (int i = 0; i < 3; ++i)
        if (classify_number(take_word(rest)) != NumberKind::finite) {
            out = "vn 0 0 0";
            return;
        }
    out.assign("vn ").append(arguments);
}

// One or two numbers; a third is for solid textures.
void assign_uv(std::string& out, std::string_view arguments)
{
    const std::string_view u = take_word(arguments), v = take_word(arguments);
    const bool usable =
        classify_number(u) == NumberKind::finite && (v.empty() || classify_number(v) == NumberKind::finite);
    if (usable)
        out.assign("vt ").append(u).append(" ").append(v.empty() ? "0" : v);
    else
        out = "vt 1e300 0";
}

}  // namespace

ObjFeed::int_type ObjFeed::underflow()
{
    while (lines_.next()) {
        const ObjStatementText s = parse_statement(lines_.line());
        const bool is_uv = uvs_ && s.kind == ObjStatement::texcoord, is_normal = s.kind == ObjStatement::normal;
        if (s.arguments.empty() && s.kind != ObjStatement::use_material && !is_uv && !is_normal) continue;
        const bool coordinates = s.kind == ObjStatement::vertex || is_normal;
        if (part_ == Part::vertices && !coordinates && !is_uv) continue;
        if (is_uv)
            assign_uv(buffer_, s.arguments);
        else if (is_normal)
            assign_normal(buffer_, s.arguments);
        else if (coordinates)
            buffer_.assign("v ").append(s.arguments);
        else if (s.kind == ObjStatement::face)
            assign_face(buffer_, s.arguments, *summary_);
        else if (s.kind == ObjStatement::smoothing && smooths(*summary_))
            buffer_.assign("o ").append(std::to_string(smoothing_group(s.arguments)));
        else if (s.kind == ObjStatement::use_material)
            buffer_.assign("usemtl ").append(std::to_string(summary_->material_index.find(s.arguments)->second));
        else
            continue;
        buffer_ += '\n';
        setg(buffer_.data(), buffer_.data(), buffer_.data() + buffer_.size());
        return traits_type::to_int_type(buffer_[0]);
    }
    return traits_type::eof();
}

}  // namespace lancer
