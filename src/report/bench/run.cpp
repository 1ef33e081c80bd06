#include "report/bench/run.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "report/bench/interval.h"
#include "report/metrics/statistics.h"
#include "report/page/csv.h"

namespace lancer {
namespace {

constexpr const char* format_key = "lancer_bench";  // in the context, with the version of the format
constexpr double format_version = 1;

// What is known of figures besides times; of each some.
constexpr std::array counter_names{"wrong_per_million", "missed_per_million",
                                   "ray_count",         "bytes",
                                   "total_bytes",       "spp",
                                   "differing_pixels",  "against",
                                   "against_low",       "against_high",
                                   "against_differs"};

double number_or_nan(const BenchFields& fields, const char* key)
{
    return fields.number(key).value_or(std::numeric_limits<double>::quiet_NaN());
}

void put(const char* key, double number, BenchFields& fields)
{
    if (!std::isnan(number)) fields.numbers.emplace_back(key, number);
}

BenchRow to_row(const BenchRun& run, const BenchFigure& f)
{
    BenchRow row;
    row.name = f.name(run.mesh), row.family = f.family, row.mesh = run.mesh, row.accel = f.accel;
    row.rays = f.rays, row.way = f.way;
    row.texts = {{"time_unit", "ns"}, {"clock", f.by_cpu ? "cpu" : "wall"}};
    put("threads", f.threads, row), put("repetitions", double(f.rounds), row);
    put("real_time", f.wall_ns, row), put("cpu_time", f.cpu_ns, row);
    put("time", f.time_ns.value, row), put("time_low", f.time_ns.low, row), put("time_high", f.time_ns.high, row);
    put("items_per_second", 1e9 / f.time_ns.value, row);
    if (f.ratio) {
        put("ratio", f.ratio->value, row), put("ratio_low", f.ratio->low, row), put("ratio_high", f.ratio->high, row);
        row.texts.emplace_back("ratio_to", run.baseline);
    }
    for (const auto& [key, number] : f.counters) put(key.c_str(), number, row);
    return row;
}

std::vector<std::string> words(const std::string& text)
{
    std::vector<std::string> all;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find(' ', at), text.size());
        if (end > at) all.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return all;
}

template <class Names, class Name>
std::string joined_words(const Names& names, const Name& name)
{
    std::string text;
    for (const auto& n : names) text += (text.empty() ? "" : " ") + name(n);
    return text;
}

BenchFigure figure_of(const BenchRow& row)
{
    BenchFigure f{row.family, row.accel, row.rays, row.way};
    f.threads = static_cast<unsigned>(std::clamp(row.number("threads").value_or(1), 1.0, 1e6));
    f.rounds = static_cast<uint64_t>(std::clamp(row.number("repetitions").value_or(0), 0.0, 1e15));
    f.wall_ns = number_or_nan(row, "real_time"), f.cpu_ns = number_or_nan(row, "cpu_time");
    f.by_cpu = row.text("clock") == "cpu";
    f.time_ns = {number_or_nan(row, "time"), number_or_nan(row, "time_low"), number_or_nan(row, "time_high")};
    if (row.number("ratio"))
        f.ratio =
            Ranged{number_or_nan(row, "ratio"), number_or_nan(row, "ratio_low"), number_or_nan(row, "ratio_high")};
    for (const char* key : counter_names)
        if (const auto number = row.number(key)) f.counters.emplace_back(key, *number);
    return f;
}

}  // namespace

std::optional<double> BenchFigure::counter(const std::string& name) const
{
    for (const auto& [key, number] : counters)
        if (key == name) return number;
    return {};
}

std::string BenchFigure::name(const std::string& mesh) const
{
    std::string text = family + "/" + mesh + "/" + accel;
    for (const std::string* part : {&rays, &way})
        if (!part->empty()) text += "/" + *part;
    return text + "/threads:" + std::to_string(threads);
}

Ranged BenchFigure::value() const
{
    if (is_speed()) return {1e3 / time_ns.value, 1e3 / time_ns.high, 1e3 / time_ns.low};
    return {1e-9 * time_ns.value, 1e-9 * time_ns.low, 1e-9 * time_ns.high};
}

bool same_figure(const BenchFigure& a, const BenchFigure& b)
{
    return a.family == b.family && a.accel == b.accel && a.rays == b.rays && a.way == b.way && a.threads == b.threads;
}

const BenchFigure* BenchRun::find(const BenchFigure& like, const std::string& accel) const
{
    BenchFigure wanted = like;
    wanted.accel = accel;
    const auto at = std::find_if(figures.begin(), figures.end(), [&](const auto& f) { return same_figure(f, wanted); });
    return at == figures.end() ? nullptr : &*at;
}

std::vector<BenchFigure> figures_of(const BenchGroup& group, const std::vector<std::string>& methods,
                                    const std::string& baseline)
{
    const auto counted = [&](const BenchTimes& t) { return group.by_cpu ? t.cpu_ns : t.wall_ns; };
    const auto base = std::find(methods.begin(), methods.end(), baseline);
    std::vector<BenchFigure> figures;
    for (size_t m = 0; m < methods.size(); ++m) {
        const BenchTimes& t = group.times[m];
        if (t.wall_ns.empty()) continue;
        BenchFigure f{group.family, methods[m], group.rays, group.way, group.threads, t.wall_ns.size()};
        f.wall_ns = median(t.wall_ns), f.cpu_ns = median(t.cpu_ns), f.by_cpu = group.by_cpu;
        f.time_ns = estimate(counted(t));
        if (base != methods.end() && methods[m] != baseline) {
            const BenchTimes& of_base = group.times[static_cast<size_t>(base - methods.begin())];
            f.ratio = estimate(speed_ratios(counted(of_base), counted(t)));
        }
        figures.push_back(std::move(f));
    }
    return figures;
}

std::string to_json(const BenchRun& run)
{
    const auto same = [](const std::string& s) { return s; };
    BenchFields context;
    context.texts = {{"file", run.file},
                     {"mesh", run.mesh},
                     {"mesh_hash", run.mesh_hash},
                     {"baseline", run.baseline},
                     {"methods", joined_words(run.methods, same)},
                     {"ray_kinds", joined_words(run.rays, [](const auto& r) { return r.first; })},
                     {"ray_hashes", joined_words(run.rays, [](const auto& r) { return r.second; })},
                     {"interrupted", run.interrupted ? "yes" : "no"}};
    context.numbers = {{format_key, format_version},
                       {"triangles", double(run.triangles)},
                       {"mesh_bytes", double(run.mesh_bytes)},
                       {"seconds", run.seconds},
                       {"picture_error", run.picture_error}};
    std::vector<BenchRow> rows;
    for (const BenchFigure& f : run.figures) rows.push_back(to_row(run, f));
    return to_json(run.machine, context, rows);
}

std::string to_csv(const BenchRun& run)
{
    std::vector<NamedFields> rows;
    for (const BenchFigure& f : run.figures) {
        const BenchRow row = to_row(run, f);
        NamedFields& fields = rows.emplace_back();
        fields = {{"name", row.name},   {"family", row.family}, {"mesh", row.mesh},
                  {"accel", row.accel}, {"rays", row.rays},     {"way", row.way}};
        for (const char* key : {"clock", "ratio_to"}) fields.emplace_back(key, row.text(key));
        const auto number = [&](const char* key) { fields.emplace_back(key, csv_number(number_or_nan(row, key))); };
        for (const char* key : {"threads", "repetitions", "real_time", "cpu_time", "time", "time_low", "time_high",
                                "items_per_second", "ratio", "ratio_low", "ratio_high"})
            number(key);
        for (const char* key : counter_names) number(key);
    }
    return named_csv(rows);
}

BenchRun read_bench_run(const std::string& name, const std::string& json)
{
    const BenchFile file = read_bench(name, json);
    const BenchFields& context = file.context;
    const auto refuse = [&](const std::string& why) { return Error(ErrorKind::invalid_input, {name, 0, 0}, why); };
    const auto version = context.number(format_key);
    if (!version) throw refuse("not written by lancer bench");
    if (*version != format_version) throw refuse("written by another version of lancer bench");
    BenchRun run;
    run.machine = file.machine;
    run.file = context.text("file"), run.mesh = context.text("mesh"), run.mesh_hash = context.text("mesh_hash");
    run.baseline = context.text("baseline"), run.methods = words(context.text("methods"));
    const std::vector<std::string> kinds = words(context.text("ray_kinds")), hashes = words(context.text("ray_hashes"));
    if (kinds.empty() || kinds.size() != hashes.size()) throw refuse("not as many ray_hashes as ray_kinds, or none");
    for (size_t i = 0; i < kinds.size(); ++i) run.rays.emplace_back(kinds[i], hashes[i]);
    run.triangles = static_cast<uint64_t>(std::clamp(context.number("triangles").value_or(0), 0.0, 1e15));
    run.mesh_bytes = static_cast<uint64_t>(std::clamp(context.number("mesh_bytes").value_or(0), 0.0, 1e18));
    run.seconds = context.number("seconds").value_or(0);
    run.picture_error = context.number("picture_error").value_or(0);
    run.interrupted = context.text("interrupted") == "yes";
    for (const BenchRow& row : file.rows) run.figures.push_back(figure_of(row));
    return run;
}

}  // namespace lancer
