#include "report/page/html.h"

#include <algorithm>

#include "report/page/html_pictures.h"
#include "report/page/number_text.h"
#include "report/page/svg_plot.h"

namespace lancer {
namespace {

constexpr const char* page_style =
    ":root{color-scheme:light dark}\n"
    "body{font:15px/1.5 system-ui,sans-serif;color:#222;background:#fff;max-width:1100px;margin:0 auto;padding:1em}\n"
    "h1{font-size:1.7em}h2{font-size:1.3em;border-bottom:1px solid #ccc;margin-top:2em}\n"
    "nav ul{columns:2;padding-left:1.2em}a{color:#0b5cad}\n"
    ".scroll{overflow-x:auto;margin:1em 0}\n"
    "table{border-collapse:collapse;font-size:.87em}\n"
    "caption{text-align:left;font-weight:600;padding:.3em 0}\n"
    "th,td{border:1px solid #ccc;padding:.2em .55em;text-align:left;vertical-align:top}\n"
    "thead th{background:#f1f1f1}\n"
    ".number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}\n"
    "td.good,p.good{color:#05683b}td.bad,p.bad{color:#b00020;font-weight:600}\n"
    "p.bad{border-left:4px solid #b00020;padding-left:.7em}\n"
    "figure{margin:1.5em 0}\n"
    "@media screen and (prefers-color-scheme:dark){\n"
    "body{color:#ddd;background:#16181b}a{color:#7ab8f5}\n"
    "h2,th,td{border-color:#444}thead th{background:#26292e}\n"
    "td.good,p.good{color:#5fd39a}td.bad,p.bad{color:#ff7d8a}p.bad{border-color:#ff7d8a}\n"
    "}\n"
    "@media print{body{max-width:none;font-size:10pt}nav{display:none}figure,tr{break-inside:avoid}\n"
    "h2{break-after:avoid}.scroll{overflow:visible}}\n";

std::string class_of(const Cell& cell)
{
    std::string name = cell.number ? "number" : "";
    if (cell.tone != Tone::plain)
        name += std::string(name.empty() ? "" : " ") + (cell.tone == Tone::good ? "good" : "bad");
    return name.empty() ? "" : " class=\"" + name + "\"";
}

std::string with_breaks(const std::string& text)
{
    std::string out;
    for (const char c : escape_xml(text)) out += c == '\n' ? std::string("<br/>") : std::string(1, c);
    return out;
}

struct HtmlBlock {
    std::string operator()(const Paragraph& p) const
    {
        const char* tone = p.tone == Tone::plain ? "" : p.tone == Tone::good ? " class=\"good\"" : " class=\"bad\"";
        return std::string("<p") + tone + ">" + escape_xml(p.text) + "</p>\n";
    }
    std::string operator()(const Table& table) const
    {
        std::string out = "<div class=\"scroll\"><table>\n";
        if (!table.caption.empty()) out += "<caption>" + escape_xml(table.caption) + "</caption>\n";
        out += "<thead><tr>";
        for (const std::string& name : table.head) out += "<th scope=\"col\">" + escape_xml(name) + "</th>";
        out += "</tr></thead>\n<tbody>\n";
        for (const auto& row : table.rows) {
            out += "<tr>";
            for (size_t i = 0; i < std::max(row.size(), table.head.size()); ++i) {
                const Cell cell = i < row.size() ? row[i] : Cell{};
                out += "<td" + class_of(cell) + ">" + with_breaks(cell.text) + "</td>";
            }
            out += "</tr>\n";
        }
        return out + "</tbody>\n</table></div>\n";
    }
    std::string operator()(const Plot& plot) const { return "<figure>\n" + plot.svg + "</figure>\n"; }
    std::string operator()(const PictureRow& row) const { return pictures_html(row); }
    std::string operator()(const Gallery& gallery) const { return gallery_html(gallery); }
    std::string operator()(const JsonData& data) const
    {
        return "<script type=\"application/json\" id=\"" + escape_xml(data.id) + "\">" + json_for_html(data.json) +
               "</script>\n";
    }
};

std::string to_html(const std::vector<Block>& blocks)
{
    std::string out;
    for (const Block& block : blocks) out += std::visit(HtmlBlock{}, block);
    return out;
}

}  // namespace

std::string json_for_html(const std::string& json)
{
    std::string out;
    out.reserve(json.size());
    for (const char c : json) {
        if (c == '<')
            out += "\\u003c";
        else if (c == '>')
            out += "\\u003e";
        else if (c == '&')
            out += "\\u0026";
        else
            out += c;
    }
    return out;
}

std::string to_html(const Document& document)
{
    const std::string title = escape_xml(document.title);
    std::string out =
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
        "<meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
        title + "</title>\n<style>\n" + page_style + plot_style() + pictures_style(document) +
        "</style>\n</head>\n<body>\n<h1>" + title + "</h1>\n" + to_html(document.opening) + "<nav><ul>\n";
    for (size_t i = 0; i < document.sections.size(); ++i)
        out +=
            "<li><a href=\"#s" + std::to_string(i) + "\">" + escape_xml(document.sections[i].heading) + "</a></li>\n";
    out += "</ul></nav>\n";
    for (size_t i = 0; i < document.sections.size(); ++i) {
        const Section& section = document.sections[i];
        out += "<section>\n<h2 id=\"s" + std::to_string(i) + "\">" + escape_xml(section.heading) + "</h2>\n" +
               to_html(section.blocks) + "</section>\n";
    }
    return out + "</body>\n</html>\n";
}

}  // namespace lancer
