#include "report/page/text_table.h"

#include <algorithm>

namespace lancer {
namespace {

// How many characters a terminal shows.
size_t shown_width(const std::string& text)
{
    return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

std::string to_text(const Table& table)
{
    std::vector<std::vector<Cell>> rows{{}};
    for (const std::string& name : table.head) rows[0].push_back({name, rows[0].size() > 0});
    rows.insert(rows.end(), table.rows.begin(), table.rows.end());
    std::vector<size_t> widths(table.head.size());
    for (const auto& row : rows)
        for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], shown_width(row[i].text));
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (size_t i = 0; i < row.size(); ++i) {
            const std::string padding(widths[i] - shown_width(row[i].text), ' ');
            line += (i ? "  " : "") + (row[i].number ? padding + row[i].text : row[i].text + padding);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += (text.empty() ? "" : "\n") + line;
    }
    return text;
}

}  // namespace lancer
