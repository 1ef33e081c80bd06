#include "bench/report/markdown.h"

#include <algorithm>

namespace lancer {
namespace {

// In one line, without what would end a cell or begin something else.
std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text) {
        if (c == '\n') {
            out += "<br>";
            continue;
        }
        if (c == '|' || c == '<' || c == '\\' || c == '`' || c == '*' || c == '_') out += '\\';
        out += c == '\r' ? ' ' : c;
    }
    return out;
}

struct MarkdownBlock {
    std::string operator()(const Paragraph& p) const { return escaped(p.text) + "\n\n"; }
    std::string operator()(const Table& table) const
    {
        std::string out = table.caption.empty() ? "" : escaped(table.caption) + "\n\n";
        std::string line = "|";
        for (size_t i = 0; i < table.head.size(); ++i) {
            const bool number = std::any_of(table.rows.begin(), table.rows.end(),
                                            [&](const auto& row) { return i < row.size() && row[i].number; });
            out += (i ? " | " : "| ") + escaped(table.head[i]);
            line += number ? "--:|" : "---|";
        }
        out += " |\n" + line + "\n";
        for (const auto& row : table.rows) {
            for (size_t i = 0; i < table.head.size(); ++i)
                out += (i ? " | " : "| ") + (i < row.size() ? escaped(row[i].text) : "");
            out += " |\n";
        }
        return out + "\n";
    }
    std::string operator()(const Plot&) const { return ""; }
    std::string operator()(const PictureRow&) const { return ""; }
    std::string operator()(const Gallery&) const { return ""; }
    std::string operator()(const JsonData&) const { return ""; }
};

std::string to_markdown(const std::vector<Block>& blocks)
{
    std::string out;
    for (const Block& block : blocks) out += std::visit(MarkdownBlock{}, block);
    return out;
}

}  // namespace

std::string to_markdown(const Document& document, int level)
{
    std::string out = to_markdown(document.opening);
    for (const Section& section : document.sections) {
        const std::string text = section.page_only ? "" : to_markdown(section.blocks);
        if (text.empty()) continue;
        out += std::string(static_cast<size_t>(level), '#') + " " + escaped(section.heading) + "\n\n" + text;
    }
    return out;
}

}  // namespace lancer
