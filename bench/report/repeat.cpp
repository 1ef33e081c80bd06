#include "bench/report/repeat.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/report/cells.h"
#include "report/page/number_text.h"

namespace lancer {
namespace {

// Programs are called by paths that may differ.
std::string program_of(const BenchFile& file)
{
    return file.machine.executable.substr(file.machine.executable.find_last_of('/') + 1);
}

double deviation(const RepeatedRow& row) { return std::abs(std::log(row.quotient())); }

Table summary_table(const std::vector<RepeatedRow>& rows)
{
    Table table{"Ratios of both runs",
                {"family", "rows", "confirmed", "not confirmed", "median of second / first", "farthest from 1"},
                {}};
    std::vector<std::string> families;
    for (const RepeatedRow& row : rows)
        if (std::find(families.begin(), families.end(), row.family) == families.end()) families.push_back(row.family);
    for (const std::string& family : families) {
        std::vector<double> quotients;
        size_t confirmed = 0;
        double farthest = 1, most = -1;
        for (const RepeatedRow& row : rows) {
            if (row.family != family) continue;
            quotients.push_back(row.quotient());
            confirmed += row.agrees();
            if (deviation(row) > most) most = deviation(row), farthest = row.quotient();
        }
        std::sort(quotients.begin(), quotients.end());
        const size_t failed = quotients.size() - confirmed;
        table.rows.push_back({text_cell(family),
                              count_cell(static_cast<double>(quotients.size())),
                              count_cell(static_cast<double>(confirmed)),
                              {std::to_string(failed), true, failed ? Tone::bad : Tone::good},
                              number_cell(quotients[quotients.size() / 2]),
                              number_cell(farthest)});
    }
    return table;
}

// The rows that are not confirmed, the worst first.
Table failures_table(std::vector<RepeatedRow> rows)
{
    std::erase_if(rows, [](const RepeatedRow& row) { return row.agrees(); });
    std::stable_sort(rows.begin(), rows.end(),
                     [](const auto& a, const auto& b) { return deviation(a) > deviation(b); });
    Table table{"Not confirmed", {"what", "first", "second", "second / first"}, {}};
    for (const RepeatedRow& row : rows)
        table.rows.push_back({text_cell(row.name),
                              {ratio_text(row.first), true},
                              {ratio_text(row.second), true},
                              number_cell(row.quotient())});
    return table;
}

}  // namespace

std::vector<RepeatedRow> repeated_rows(const std::vector<BenchFile>& first, const std::vector<BenchFile>& second)
{
    std::map<std::string, const BenchRow*> by_name;
    for (const BenchRow* row : rows_of(second, "")) by_name.emplace(row->name, row);
    std::vector<RepeatedRow> repeated;
    for (const BenchRow* row : rows_of(first, "")) {
        const auto other = by_name.find(row->name);
        if (other == by_name.end()) continue;
        const auto a = row->speed_ratio(), b = other->second->speed_ratio();
        // What is compared with itself is 1 in every run.
        const bool is_base = a && a->low == 1 && a->high == 1;
        if (a && b && !is_base) repeated.push_back({row->name, row->family, *a, *b});
    }
    return repeated;
}

std::vector<std::string> comparison_reasons(const std::vector<BenchFile>& first, const std::vector<BenchFile>& second)
{
    Findings findings;
    for (const BenchFile& a : first)
        for (const BenchFile& b : second)
            if (program_of(a) == program_of(b)) findings.add(program_of(a), not_comparable(a.machine, b.machine));
    return findings.lines();
}

Section repeat_section(const std::vector<BenchFile>& first, const std::vector<BenchFile>& second)
{
    Section section{"Against an earlier run", {}};
    const std::vector<std::string> reasons = comparison_reasons(first, second);
    for (const std::string& reason : reasons)
        section.blocks.push_back(Paragraph{"Not comparable: " + reason + ".", Tone::bad});
    const std::vector<RepeatedRow> rows = repeated_rows(first, second);
    if (rows.empty()) {
        section.blocks.push_back(Paragraph{"No ratio occurs in both runs.", Tone::bad});
        return section;
    }
    section.blocks.push_back(
        Paragraph{"A ratio is confirmed if both runs give it within 5 %, or if the ranges of their rounds overlap."});
    section.blocks.push_back(summary_table(rows));
    Table failures = failures_table(rows);
    if (!failures.rows.empty()) section.blocks.push_back(std::move(failures));
    return section;
}

}  // namespace lancer
