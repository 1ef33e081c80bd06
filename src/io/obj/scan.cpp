#include "io/obj/scan.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/names.h"
#include "io/obj/corner.h"
#include "io/obj/repeated_warning.h"

namespace lancer {
namespace {

// A comment after numbers may stand close, but "1.#QNAN" is one word, so that the message can name it.
std::string_view without_comment(std::string_view s)
{
    size_t at = s.find('#');
    while (at != std::string_view::npos && at > 0 && s[at - 1] == '.') at = s.find('#', at + 1);
    return trim(s.substr(0, at));
}

class Scanner {
public:
    Scanner(std::string_view text, const std::string& file, Diagnostics& diagnostics, const ObjLimits& limits)
        : text_(text), file_(file), diagnostics_(diagnostics), limits_(limits)
    {
    }
    std::optional<ObjSummary> scan();

private:
    struct Kind {
        const char *index, *one, *many;
        uint64_t so_far = 0, all = 0;
    };

    void count_elements();
    void check_line(const ObjStatementText& statement);
    void check_vertex(std::string_view arguments);
    bool check_numbers(std::string_view& arguments);
    bool check_attribute(std::string_view digits, Kind& kind, RepeatedWarning& none);
    void check_face(std::string_view corners);
    bool check_corner(std::string_view corner);
    bool check_index(std::string_view digits, Kind& kind);
    void use_material(std::string_view name);
    void add_library(std::string_view names);
    void check_limits();
    bool error(const std::string& message)
    {
        diagnostics_.error({file_, line_, 0}, message);
        ++errors_;
        return false;
    }

    std::string_view text_;
    const std::string& file_;
    Diagnostics& diagnostics_;
    const ObjLimits limits_;
    ObjSummary summary_;
    uint32_t line_ = 0;
    uint64_t errors_ = 0;
    Kind vertex_{"face index ", "vertex", "vertices"};
    Kind texcoord_{"face texture index ", "texture coordinate", "texture coordinates"};
    Kind normal_{"face normal index ", "normal", "normals"};
    RepeatedWarning unknown_{"statement of an unknown kind ignored"};
    RepeatedWarning skipped_{"line or point ignored"};
    RepeatedWarning short_{"face with fewer than 3 corners dropped"};
    RepeatedWarning no_texcoord_{"texture index ignored: the file has no vt"};
    RepeatedWarning no_normal_{"normal index ignored: the file has no vn"};
    RepeatedWarning zero_index_{"index 0 of a texture coordinate or normal ignored"};
};

std::optional<ObjSummary> Scanner::scan()
{
    count_elements();
    constexpr uint64_t enough_errors = 1000;
    TextLines lines(text_);
    while (errors_ < enough_errors && lines.next()) {
        line_ = lines.number();
        check_line(parse_statement(lines.line()));
    }
    line_ = 0;
    if (errors_ == 0) check_limits();
    for (const RepeatedWarning* w : {&unknown_, &skipped_, &short_, &no_texcoord_, &no_normal_, &zero_index_})
        w->give(file_, diagnostics_);
    if (errors_) return {};
    return std::move(summary_);
}

// First of all, because a positive index may refer to what comes later in the file.
void Scanner::count_elements()
{
    TextLines lines(text_);
    while (lines.next()) {
        std::string_view line = lines.line();
        if (line.empty() || line[0] != 'v') continue;
        const std::string_view word = take_word(line);
        if (word == "v") ++vertex_.all;
        if (word == "vn") ++normal_.all;
        if (word == "vt") ++texcoord_.all;
    }
    summary_.vertices = vertex_.all;
    summary_.normals = normal_.all;
    summary_.texcoords = texcoord_.all;
}

void Scanner::check_line(const ObjStatementText& statement)
{
    switch (statement.kind) {
        case ObjStatement::vertex:
            ++vertex_.so_far;
            return check_vertex(statement.arguments);
        case ObjStatement::normal:
            ++normal_.so_far;
            return;
        case ObjStatement::texcoord:
            ++texcoord_.so_far;
            return;
        case ObjStatement::face:
            return check_face(statement.arguments);
        case ObjStatement::use_material:
            return use_material(statement.arguments);
        case ObjStatement::library:
            return add_library(statement.arguments);
        case ObjStatement::smoothing:
            summary_.smoothing_groups = summary_.smoothing_groups || smoothing_group(statement.arguments) != 0;
            return;
        case ObjStatement::line_or_point:
            return skipped_.add(line_);
        case ObjStatement::unknown:
            return unknown_.add(line_);
        case ObjStatement::ignored:
            return;
    }
}

// A single number after the three coordinates is a weight and not used, three are a colour.
void Scanner::check_vertex(std::string_view arguments)
{
    if (!check_numbers(arguments) || summary_.vertex_colors) return;
    take_word(arguments);
    take_word(arguments);
    summary_.vertex_colors = !take_word(arguments).empty();
}

// Takes them off the arguments.
bool Scanner::check_numbers(std::string_view& arguments)
{
    for (int i = 0; i < 3; ++i) {
        const std::string_view word = take_word(arguments);
        if (word.empty()) return error("v needs 3 numbers, has " + std::to_string(i));
        const NumberKind kind = classify_number(word);
        if (kind == NumberKind::finite) continue;
        return error(in_quotes(word) +
                     (kind == NumberKind::not_finite ? " is not a finite number" : " is not a number"));
    }
    return true;
}

void Scanner::check_face(std::string_view corners)
{
    uint64_t n = 0;
    for (std::string_view word = take_word(corners); !word.empty(); word = take_word(corners), ++n)
        if (!check_corner(word)) return;
    if (n > 0) ++summary_.faces;
    if (n < 3) return short_.add(line_);
    if (n > limits_.corners_of_face)
        error("a face with " + std::to_string(n) + " corners; at most " + std::to_string(limits_.corners_of_face) +
              " are supported");
    summary_.triangles += n - 2;
}

// i, i/j, i//k or i/j/k, where j and k may be left out: some programs write "1//" for "1".
bool Scanner::check_corner(std::string_view corner)
{
    const std::optional<CornerParts> parts = split_corner(corner);
    if (!parts) return error("face corner " + in_quotes(corner) + " is not an index like 1, 1/2, 1//3 or 1/2/3");
    if (!check_index((*parts)[0], vertex_)) return false;
    if (!check_attribute((*parts)[1], texcoord_, no_texcoord_)) return false;
    if (!check_attribute((*parts)[2], normal_, no_normal_)) return false;
    if (refers((*parts)[2], normal_.all)) summary_.face_normals = true;
    return true;
}

// What a corner may do without is ignored where there is nothing that it could refer to.
bool Scanner::check_attribute(std::string_view digits, Kind& kind, RepeatedWarning& none)
{
    if (digits.empty()) return true;
    if (refers(digits, kind.all)) return check_index(digits, kind);
    (is_zero(digits) ? zero_index_ : none).add(line_);
    return true;
}

bool Scanner::check_index(std::string_view digits, Kind& kind)
{
    int64_t index = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, problem] = std::from_chars(digits.data(), end, index);
    if (stop != end || problem == std::errc::invalid_argument)
        return error(kind.index + in_quotes(digits) + " is not an integer");
    if (problem == std::errc() && index == 0) return error(std::string(kind.index) + "0: indices start at 1");
    const bool negative = digits[0] == '-';
    const uint64_t distance = negative ? 0 - static_cast<uint64_t>(index) : static_cast<uint64_t>(index);
    const uint64_t there = negative ? kind.so_far : kind.all;
    if (problem != std::errc() || distance > there) {
        const std::string name = there == 1 ? kind.one : kind.many;
        std::string text = in_quotes(digits);
        text = text.substr(1, text.size() - 2);
        return error(kind.index + text + " is out of range: " +
                     (negative ? std::to_string(there) + " " + name + (there == 1 ? " comes" : " come") + " before it"
                               : "the file has " + std::to_string(there) + " " + name));
    }
    if (!negative && distance > kind.so_far) summary_.forward_references = true;
    return true;
}

void Scanner::use_material(std::string_view name)
{
    const auto found = summary_.material_index.find(name);
    if (found != summary_.material_index.end()) {
        ++summary_.materials[found->second].count;
        return;
    }
    summary_.material_index.emplace(std::string(name), static_cast<uint32_t>(summary_.materials.size()));
    summary_.materials.push_back({std::string(name), line_, 1});
}

void Scanner::add_library(std::string_view names)
{
    auto& all = summary_.libraries;
    const auto same = [&](const ObjSummary::Name& l) { return l.name == names; };
    if (const auto l = std::find_if(all.begin(), all.end(), same); l != all.end()) {
        ++l->count;
        return;
    }
    all.push_back({std::string(names), line_, 1});
    if (all.size() == limits_.libraries + 1) error("more than " + std::to_string(limits_.libraries) + " mtllib files");
    if (all.size() > limits_.libraries) all.pop_back();
}

void Scanner::check_limits()
{
    if (summary_.triangles == 0) error(text_.empty() ? "the file is empty" : "the file has no face");
    if (std::max({summary_.vertices, summary_.normals, summary_.texcoords}) > limits_.vertices)
        error("more than " + std::to_string(limits_.vertices) + " vertices, normals or texture coordinates");
    if (summary_.triangles > limits_.triangles) error("more than " + std::to_string(limits_.triangles) + " triangles");
}

}  // namespace

ObjStatementText parse_statement(std::string_view line)
{
    const std::string_view word = take_word(line);
    if (word == "v") return {ObjStatement::vertex, without_comment(line)};
    if (word == "f") return {ObjStatement::face, without_comment(line)};
    if (word == "vn") return {ObjStatement::normal, without_comment(line)};
    if (word == "vt") return {ObjStatement::texcoord, without_comment(line)};
    if (word.empty() || word[0] == '#') return {ObjStatement::ignored, {}};
    if (word == "usemtl") return {ObjStatement::use_material, trim(line)};
    if (word == "mtllib") return {ObjStatement::library, trim(line)};
    if (word == "s") return {ObjStatement::smoothing, without_comment(line)};
    if (word == "l" || word == "p") return {ObjStatement::line_or_point, {}};
    for (const char* known : {"g", "o", "mg", "lod", "bevel", "c_interp", "d_interp", "usemap", "maplib"})
        if (word == known) return {ObjStatement::ignored, {}};
    return {ObjStatement::unknown, word};
}

uint32_t smoothing_group(std::string_view arguments)
{
    const std::string_view word = take_word(arguments);
    if (word.empty() || word == "off") return 0;
    uint32_t group = 0;
    const auto [stop, problem] = std::from_chars(word.data(), word.data() + word.size(), group);
    return problem == std::errc() && stop == word.data() + word.size() ? group : 1;
}

std::optional<ObjSummary> scan_obj(std::string_view text, const std::string& file, Diagnostics& diagnostics,
                                   const ObjLimits& limits)
{
    return Scanner(text, file, diagnostics, limits).scan();
}

uint32_t line_of(std::string_view text, ObjStatement kind, uint64_t index)
{
    TextLines lines(text);
    while (lines.next()) {
        const ObjStatementText s = parse_statement(lines.line());
        const bool counts = !s.arguments.empty() || kind == ObjStatement::texcoord || kind == ObjStatement::normal;
        if (s.kind == kind && counts && index-- == 0) return lines.number();
    }
    return 0;
}

}  // namespace lancer
