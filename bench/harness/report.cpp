#include "harness/report.h"

#include "io/atomic_file.h"
#include "report/bench/interval.h"
#include "report/bench/results.h"
#include "report/metrics/statistics.h"

namespace lancer::bench {
namespace {

std::string to_csv(const std::vector<Json>& rows)
{
    std::vector<NamedFields> named;
    for (const Json& row : rows) {
        NamedFields& fields = named.emplace_back();
        for (const auto& [name, value] : row.items())
            fields.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
    }
    return named_csv(named);
}

}  // namespace

const std::vector<double>& counted(const Timing& timing, unsigned threads)
{
    return threads == 1 ? timing.cpu : timing.wall;
}

Json& Report::add(const std::string& family, const std::string& name)
{
    const std::string full = family + "/" + name;
    rows_.push_back({{"name", full},
                     {"run_name", full},
                     {"run_type", "aggregate"},
                     {"aggregate_name", "median"},
                     {"family", family}});
    return rows_.back();
}

Json& Report::add(const std::string& family, const std::string& name, const Timing& timing, unsigned threads)
{
    Json& row = add(family, name);
    const Spread spread = spread_of(counted(timing, threads));
    row["threads"] = threads;
    row["repetitions"] = timing.wall.size();
    row["real_time"] = median(timing.wall);
    row["cpu_time"] = median(timing.cpu);
    row["time_unit"] = "ns";
    row["clock"] = threads == 1 ? "cpu" : "wall";
    row["min"] = spread.min;
    row["max"] = spread.max;
    row["items_per_second"] = 1e9 / spread.median;
    return row;
}

void add_ratio(Json& row, const std::string& base_name, const Timing& base, const Timing& timing, unsigned threads)
{
    const std::vector<double> ratios = speed_ratios(counted(base, threads), counted(timing, threads));
    const Spread spread = spread_of(ratios);
    row["ratio"] = spread.median;
    row["ratio_min"] = spread.min;
    row["ratio_max"] = spread.max;
    const Interval interval = median_interval(ratios);
    row["ratio_low"] = interval.low;
    row["ratio_high"] = interval.high;
    row["ratio_to"] = base_name;
    if (base.instructions && timing.instructions) {
        row["instructions"] = *timing.instructions;
        row["instructions_ratio"] = *base.instructions / *timing.instructions;
    }
}

void Report::write(const std::string& path) const
{
    const std::string stem = path.substr(0, path.size() - (path.ends_with(".json") ? 5 : 0));
    const Json all{{"context", context_}, {"benchmarks", rows_}};
    // A file name need not be UTF-8; the text must be.
    write_text(stem + ".json", all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    write_text(stem + ".csv", to_csv(rows_));
}

std::string joined(std::initializer_list<std::string> parts)
{
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : "/") + part;
    return text;
}

}  // namespace lancer::bench
