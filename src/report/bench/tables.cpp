#include "report/bench/tables.h"

#include <algorithm>
#include <cmath>

#include "report/page/number_text.h"
#include "report/page/svg_frame.h"

namespace lancer {
namespace {

// With intervals in lines of their own: that of the ratio, where there is one. Columns stay narrow.
std::string value_text_of(const BenchFigure& f, bool intervals)
{
    const Ranged value = f.value();
    std::string text = significant(value.value);
    if (f.ratio)
        text += (intervals ? "\n×" : " ×") + (intervals ? significant(f.ratio->value) : fixed_text(f.ratio->value, 2));
    const std::string range = ranged_text(f.ratio ? *f.ratio : value);
    if (const size_t bracket = range.find('['); intervals && bracket != std::string::npos)
        text += '\n' + range.substr(bracket);
    return text;
}

// What a row of the table says of each method.
struct FigureRow {
    std::string what, threads;
    std::vector<Cell> cells;
};

std::string what_of(const BenchRun& run, const BenchFigure& f)
{
    if (f.family == "build") return "building, s";
    if (f.family == "picture") return "picture to error " + significant(run.picture_error, 2) + ", s";
    return f.rays + " " + f.way + ", M/s";
}

std::string megabytes_of(double bytes) { return significant(1e-6 * bytes, 3); }

// A row about something else that is known of figures; empty cells where it is not.
template <class Show>
void add_counters(const BenchRun& run, const BenchFigure& like, const std::string& counter, const std::string& what,
                  const Show& show, std::vector<FigureRow>& rows)
{
    FigureRow row{what, "", {}};
    bool any = false;
    for (const std::string& method : run.methods) {
        const BenchFigure* f = run.find(like, method);
        const auto number = f ? f->counter(counter) : std::nullopt;
        any |= number.has_value();
        row.cells.push_back(number ? show(*number) : Cell{"", true});
    }
    if (any) rows.push_back(std::move(row));
}

// The worst of a counter among all figures of a method about one kind of ray.
std::optional<double> worst_of(const BenchRun& run, const std::string& method, const std::string& rays,
                               const char* counter)
{
    std::optional<double> worst;
    for (const BenchFigure& f : run.figures)
        if (f.accel == method && f.rays == rays && f.counter(counter))
            worst = std::max(worst.value_or(0), *f.counter(counter));
    return worst;
}

// Wrong answers and missed hits, of the worse way to ask.
void add_answers(const BenchRun& run, const std::string& rays, std::vector<FigureRow>& rows)
{
    FigureRow row{rays + ", wrong | missed of 10⁶", "", {}};
    bool any = false;
    for (const std::string& method : run.methods) {
        const auto wrong = worst_of(run, method, rays, "wrong_per_million");
        const auto missed = worst_of(run, method, rays, "missed_per_million");
        any |= wrong && missed;
        row.cells.push_back(wrong && missed ? Cell{significant(*wrong) + " | " + significant(*missed), true,
                                                   *wrong + *missed > 0 ? Tone::bad : Tone::plain}
                                            : Cell{"", true});
    }
    if (any) rows.push_back(std::move(row));
}

Cell plain_number(double x) { return {count_text(x), true}; }

}  // namespace

Table figures_table(const BenchRun& run, bool intervals)
{
    std::vector<FigureRow> rows;
    std::vector<const BenchFigure*> seen;
    const auto is_seen = [&](const BenchFigure& f) {
        return std::any_of(seen.begin(), seen.end(), [&](const BenchFigure* other) {
            BenchFigure same = f;
            same.accel = other->accel;
            return same_figure(same, *other);
        });
    };
    for (const BenchFigure& f : run.figures) {
        if (is_seen(f)) continue;
        seen.push_back(&f);
        FigureRow row{what_of(run, f), std::to_string(f.threads), {}};
        for (const std::string& method : run.methods) {
            const BenchFigure* of_method = run.find(f, method);
            row.cells.push_back({of_method ? value_text_of(*of_method, intervals) : "", true});
        }
        rows.push_back(std::move(row));
    }
    const auto megabytes = [](double x) { return Cell{megabytes_of(x), true}; };
    if (const auto build = std::find_if(seen.begin(), seen.end(), [](const auto* f) { return f->family == "build"; });
        build != seen.end()) {
        add_counters(run, **build, "bytes", "tree, MB", megabytes, rows);
        add_counters(run, **build, "total_bytes", "tree and mesh, MB", megabytes, rows);
    }
    if (const auto drawn = std::find_if(seen.begin(), seen.end(), [](const auto* f) { return f->family == "picture"; });
        drawn != seen.end())
        add_counters(run, **drawn, "differing_pixels", "picture, other pixels", plain_number, rows);
    for (const auto& [kind, hash] : run.rays) add_answers(run, kind, rows);
    Table table{"", {"what", "threads"}, {}};
    for (const std::string& method : run.methods) table.head.push_back(method);
    for (FigureRow& row : rows) {
        auto& cells = table.rows.emplace_back();
        cells = {{row.what}, {row.threads, true}};
        for (Cell& cell : row.cells) cells.push_back(std::move(cell));
    }
    return table;
}

Table run_table(const BenchRun& run)
{
    const MachineBlock& m = run.machine;
    Table table{"", {"", ""}, {}};
    const auto tell = [&](const char* what, const std::string& value) {
        if (!value.empty()) table.rows.push_back({{what}, {value}});
    };
    tell("mesh", run.file);
    tell("triangles", count_text(double(run.triangles)));
    tell("mesh, MB", megabytes_of(double(run.mesh_bytes)));
    tell("seconds", significant(run.seconds) + (run.interrupted ? ", interrupted" : ""));
    tell("date", m.date);
    tell("processor", m.cpu + (m.num_cpus ? ", " + std::to_string(*m.num_cpus) + " CPUs" : ""));
    const auto load = [](const std::optional<double>& x) { return x ? fixed_text(*x, 2) : "not known"; };
    tell("load", load(m.load) + " at the start, " + load(m.load_at_end) + " at the end");
    tell("Embree", m.embree + ", " + m.embree_isa + " (widest here: " + m.widest_isa + ")" +
                       (m.embree_asserts.value_or(false) ? ", with assertions" : ""));
    tell("threads by", m.tbb);
    tell("compiler", m.compiler + ", " + m.flags);
    tell("lancer", m.lancer + ", build " + (m.build_id.empty() ? "not known" : m.build_id));
    return table;
}

Table against_table(const BenchAgainst& against, bool all)
{
    Table table{"", {"figure", "threads", "method", "ratio before", "ratio now", "now / before", ""}, {}};
    for (const AgainstCell& cell : against.cells) {
        if (!all && !cell.differs) continue;
        const BenchFigure& f = *cell.now;
        const std::string what = f.family == "rays" ? f.rays + " " + f.way : f.family;
        table.rows.push_back({{what},
                              {std::to_string(f.threads), true},
                              {f.accel},
                              {ranged_text(cell.before), true},
                              {ranged_text(*f.ratio), true},
                              {ranged_text(cell.quotient), true},
                              {cell.differs  ? "differs"
                               : cell.judged ? ""
                                             : "too few rounds",
                               false, cell.differs ? Tone::bad : Tone::plain}});
    }
    return table;
}

std::string verdict_of(const BenchAgainst& against)
{
    const auto count = [](size_t n) { return count_text(double(n)); };
    return "against " + against.earlier + ": of " + count(against.cells.size()) + " ratios " + count(against.close()) +
           " agree within 5 %; " + count(against.differing()) + " differ beyond both intervals";
}

}  // namespace lancer
