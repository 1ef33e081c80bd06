#include "io/ply/header.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/names.h"
#include "io/text_file.h"

namespace lancer {
namespace {

// Both sets of names that there are, in the order of PlyType.
constexpr std::array<std::array<std::string_view, 2>, 8> type_names{{{"char", "int8"},
                                                                     {"uchar", "uint8"},
                                                                     {"short", "int16"},
                                                                     {"ushort", "uint16"},
                                                                     {"int", "int32"},
                                                                     {"uint", "uint32"},
                                                                     {"float", "float32"},
                                                                     {"double", "float64"}}};

std::optional<PlyType> type_of(std::string_view word)
{
    for (size_t i = 0; i < type_names.size(); ++i)
        if (word == type_names[i][0] || word == type_names[i][1]) return static_cast<PlyType>(i);
    return {};
}

// Lines end in a line feed, which a carriage return may come before, or in a carriage return alone.
class HeaderLines {
public:
    explicit HeaderLines(std::string_view bytes) : bytes_(bytes) {}

    // False at the end of the file.
    bool next()
    {
        if (position_ >= bytes_.size()) return false;
        const size_t end = std::min(bytes_.find_first_of("\r\n", position_), bytes_.size());
        line_ = bytes_.substr(position_, end - position_);
        position_ = end + (bytes_.substr(end, 2) == "\r\n" ? 2 : 1);
        ++number_;
        return true;
    }
    std::string_view line() const { return line_; }
    uint32_t number() const { return number_; }
    size_t position() const { return std::min(position_, bytes_.size()); }

private:
    std::string_view bytes_, line_;
    size_t position_ = 0;
    uint32_t number_ = 0;
};

class HeaderReader {
public:
    // What is wrong with a line that is not the first; empty: nothing.
    std::string read(std::string_view line)
    {
        const std::string_view key = take_word(line);
        if (key.empty() || key == "comment" || key == "obj_info") return {};
        if (key == "format") return read_format(line);
        if (key == "element") return read_element(line);
        if (key == "property") return read_property(line);
        constexpr std::array<std::string_view, 5> known{"format", "element", "property", "comment", "end_header"};
        return "unknown word " + in_quotes(std::string(key)) + " in the header" + suggestion(key, known);
    }
    bool has_format() const { return has_format_; }
    PlyHeader& header() { return header_; }

private:
    std::string read_format(std::string_view rest)
    {
        const std::string_view form = take_word(rest), version = take_word(rest);
        constexpr std::array<std::string_view, 3> forms{"ascii", "binary_little_endian", "binary_big_endian"};
        const auto found = std::find(forms.begin(), forms.end(), form);
        if (found == forms.end()) return "unknown format " + in_quotes(std::string(form)) + suggestion(form, forms);
        if (version != "1.0") return "format must have the version 1.0";
        header_.form = static_cast<PlyHeader::Form>(found - forms.begin());
        has_format_ = true;
        return {};
    }
    std::string read_element(std::string_view rest)
    {
        PlyElement element;
        element.name = take_word(rest);
        const std::string_view count = take_word(rest);
        const auto [end, problem] = std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (element.name.empty() || problem != std::errc{} || end != count.data() + count.size())
            return "element must have a name and a number";
        header_.elements.push_back(std::move(element));
        return {};
    }
    std::string read_property(std::string_view rest)
    {
        if (header_.elements.empty()) return "property before any element";
        std::string_view word = take_word(rest);
        PlyProperty property{};
        const bool is_list = word == "list";
        if (is_list) {
            word = take_word(rest);
            property.count = type_of(word);
            if (!property.count || size_of(*property.count) == 8 || *property.count == PlyType::float32)
                return unknown_type(word, "the length of a list");
            word = take_word(rest);
        }
        const std::optional<PlyType> type = type_of(word);
        if (!type) return unknown_type(word, "a property");
        property.type = *type;
        property.name = take_word(rest);
        if (property.name.empty()) return "property must have a name";
        header_.elements.back().properties.push_back(std::move(property));
        return {};
    }
    static std::string unknown_type(std::string_view word, const char* of)
    {
        std::vector<std::string_view> known;
        for (const auto& names : type_names) known.insert(known.end(), names.begin(), names.end());
        return in_quotes(std::string(word)) + " is no type of " + of + suggestion(word, known);
    }

    PlyHeader header_;
    bool has_format_ = false;
};

}  // namespace

size_t PlyElement::least_size() const
{
    size_t size = 0;
    for (const PlyProperty& p : properties) size += size_of(p.count.value_or(p.type));
    return size;
}

bool PlyElement::has_list() const
{
    return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.count.has_value(); });
}

std::optional<PlyHeader> read_ply_header(std::string_view bytes, const std::string& file, Diagnostics& diagnostics)
{
    HeaderLines lines(bytes);
    HeaderReader reader;
    const auto fail = [&](const std::string& message) {
        diagnostics.error({file, lines.number(), 0}, message);
        return std::nullopt;
    };
    if (!lines.next() || lines.line() != "ply") return fail("not a PLY file: its first line must be ply");
    while (lines.next()) {
        std::string_view rest = lines.line();
        if (take_word(rest) == "end_header") {
            if (!reader.has_format()) return fail("the header has no format");
            reader.header().end = lines.position(), reader.header().end_line = lines.number();
            return std::move(reader.header());
        }
        if (const std::string problem = reader.read(lines.line()); !problem.empty()) return fail(problem);
    }
    return fail("the header does not end: there is no end_header");
}

}  // namespace lancer
