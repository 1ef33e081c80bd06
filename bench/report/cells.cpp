#include "bench/report/cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/page/number_text.h"
#include "report/page/svg_frame.h"

namespace lancer {
namespace {

// What every timed row has: shown as speed with its range.
constexpr std::array timing_fields{"repetitions",      "real_time", "cpu_time",       "min",       "max",
                                   "items_per_second", "ratio",     "ratio_min",      "ratio_max", "ratio_to",
                                   "run_name",         "run_type",  "aggregate_name", "time_unit", "clock",
                                   "threads"};

bool is_timing(const std::string& key)
{
    return std::find(timing_fields.begin(), timing_fields.end(), key) != timing_fields.end();
}

template <class Fields>
void add_keys(const Fields& fields, std::vector<std::string>& keys)
{
    for (const auto& [key, value] : fields)
        if (!is_timing(key) && std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
}

Cell field_cell(const BenchRow& row, const std::string& key)
{
    if (const auto x = row.number(key)) return *x == std::trunc(*x) ? count_cell(x) : number_cell(x);
    const std::string text = row.text(key);
    return {text, false, text == "yes" ? Tone::good : text == "no" ? Tone::bad : Tone::plain};
}

std::string words_of(std::string key)
{
    std::replace(key.begin(), key.end(), '_', ' ');
    return key;
}

}  // namespace

Cell number_cell(double x) { return {std::isnan(x) ? "" : significant(x), true}; }
Cell number_cell(const std::optional<double>& x) { return {x ? significant(*x) : "", true}; }
Cell count_cell(const std::optional<double>& x) { return {x ? count_text(*x) : "", true}; }
Cell ranged_cell(const Ranged& r) { return {std::isnan(r.value) ? "" : ranged_text(r), true}; }

std::string ratio_text(const Ratio& r) { return "×" + ranged_text({r.value, r.low, r.high}); }

Table table_of(const BenchRows& rows, const std::string& caption)
{
    Table table{caption, {"what"}, {}};
    const bool timed = std::any_of(rows.begin(), rows.end(),
                                   [](const BenchRow* r) { return !std::isnan(r->mega_per_second().value); });
    const bool related = std::any_of(rows.begin(), rows.end(), [](const BenchRow* r) { return r->speed_ratio(); });
    if (timed) table.head.push_back("M/s");
    if (related) table.head.push_back("speed against the first");
    std::vector<std::string> keys;
    for (const BenchRow* row : rows) add_keys(row->texts, keys), add_keys(row->numbers, keys);
    for (const std::string& key : keys) table.head.push_back(words_of(key));
    for (const BenchRow* row : rows) {
        std::vector<Cell> cells{text_cell(row->name.substr(row->name.find('/') + 1))};
        if (timed) cells.push_back(ranged_cell(row->mega_per_second()));
        if (related) {
            const auto ratio = row->speed_ratio();
            cells.push_back({ratio ? ratio_text(*ratio) : "", true});
        }
        for (const std::string& key : keys) cells.push_back(field_cell(*row, key));
        table.rows.push_back(std::move(cells));
    }
    return table;
}

const BenchRow* find_row(const BenchRows& rows, const RowKey& key)
{
    const auto fits = [](const std::string& wanted, const std::string& there) {
        return wanted.empty() || wanted == there;
    };
    for (const BenchRow* row : rows)
        if (fits(key.mesh, row->mesh) && fits(key.accel, row->accel) && fits(key.rays, row->rays) &&
            fits(key.way, row->way))
            return row;
    return nullptr;
}

}  // namespace lancer
