#include "bench/report/speed.h"

#include <algorithm>
#include <cmath>

#include "bench/report/cells.h"
#include "report/metrics/statistics.h"
#include "report/page/number_text.h"

namespace lancer {
namespace {

// What the ratios are to, one ray at a time: what the product uses, and Embree at its fastest.
const std::string robust_embree = "embree-robust-high-avx2", fast_embree = "embree-fast-high-avx2";

// The modes of Embree begin so; "embree" alone is the accelerator of that name.
bool is_bare_embree(const std::string& accel) { return accel.starts_with("embree-"); }

// Plots show the modes that differ by more than a little; the tables have them all.
std::vector<std::string> plotted(const BenchRows& rows)
{
    std::vector<std::string> names = distinct(rows, &BenchRow::accel);
    std::erase_if(names, [](const std::string& name) {
        return is_bare_embree(name) && (name.find("-medium-") != std::string::npos || name.ends_with("+refine"));
    });
    return names;
}

std::optional<Ratio> ratio_to(const BenchRows& rows, const RowKey& key, const std::string& base)
{
    const BenchRow* row = find_row(rows, key);
    if (!row || !row->speed_ratio()) return {};
    if (base == robust_embree) return row->speed_ratio();
    const BenchRow* other = find_row(rows, {key.mesh, base, key.rays, "single"});
    if (!other || !other->speed_ratio()) return {};
    return ratio(*row->speed_ratio(), *other->speed_ratio());
}

// Over all kinds of rays for which there is a ratio; NaN if there is none.
double mean_ratio(const BenchRows& rows, const std::string& mesh, const std::string& accel, const std::string& base)
{
    std::vector<double> values;
    for (const std::string& kind : distinct(rows, &BenchRow::rays))
        if (const auto r = ratio_to(rows, {mesh, accel, kind, "single"}, base)) values.push_back(r->value);
    return geometric_mean(values);
}

std::vector<std::string> own_accelerators(const BenchRows& rows)
{
    std::vector<std::string> names = distinct(where(rows, &BenchRow::way, "single"), &BenchRow::accel);
    std::erase_if(names, is_bare_embree);
    return names;
}

Table glance_table(const BenchRows& rows, const std::string& base)
{
    const std::vector<std::string> kinds = distinct(rows, &BenchRow::rays);
    Table table{"Times as fast as " + base + ", each one ray at a time", {"mesh", "accelerator"}, {}};
    table.head.insert(table.head.end(), kinds.begin(), kinds.end());
    table.head.emplace_back("geometric mean");
    for (const std::string& mesh : distinct(rows, &BenchRow::mesh)) {
        for (const std::string& accel : own_accelerators(rows)) {
            std::vector<Cell> cells{text_cell(mesh), text_cell(accel)};
            for (const std::string& kind : kinds) {
                const auto r = ratio_to(rows, {mesh, accel, kind, "single"}, base);
                cells.push_back({r ? ratio_text(*r) : "", true});
            }
            cells.push_back(number_cell(mean_ratio(rows, mesh, accel, base)));
            table.rows.push_back(std::move(cells));
        }
    }
    return table;
}

// All accelerators beside each other, as powers of ten lie between them.
BarPlot ladder_plot(const BenchRows& rows)
{
    BarPlot plot{{"Speed of all accelerators",
                  "Bars for each mesh: how many times as fast as " + robust_embree +
                      " each accelerator is, one ray at a time, as the geometric mean over the kinds of rays.",
                  "mesh", "times " + robust_embree},
                 Scale::logarithmic,
                 distinct(rows, &BenchRow::mesh),
                 {},
                 {{1, robust_embree}}};
    for (const std::string& accel : plotted(where(rows, &BenchRow::way, "single"))) {
        BarSeries series{accel, {}};
        for (const std::string& mesh : plot.groups) {
            const double mean = mean_ratio(rows, mesh, accel, robust_embree);
            series.bars.push_back(std::isnan(mean) ? std::nullopt : std::optional(Ranged{mean}));
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

// The project's accelerator that is fastest over all meshes, other than Embree; empty if there is none.
std::string fastest_own(const BenchRows& rows)
{
    std::string best;
    double best_speed = 0;
    for (const std::string& accel : own_accelerators(rows)) {
        if (accel == "embree") continue;
        std::vector<double> means;
        for (const std::string& mesh : distinct(rows, &BenchRow::mesh)) {
            const double mean = mean_ratio(rows, mesh, accel, robust_embree);
            if (!std::isnan(mean)) means.push_back(mean);
        }
        const double speed = geometric_mean(means);
        if (speed > best_speed) best = accel, best_speed = speed;
    }
    return best;
}

BarPlot kinds_plot(const BenchRows& rows, const std::string& accel, const std::string& base)
{
    BarPlot plot{{accel + " against " + base,
                  "Bars for each mesh and kind of ray: how many times as fast as " + base + " " + accel +
                      " is, one ray at a time. Whiskers: least and largest of the rounds.",
                  "mesh", "times " + base},
                 Scale::linear,
                 distinct(rows, &BenchRow::mesh),
                 {},
                 {{1, "equal"}}};
    for (const std::string& kind : distinct(rows, &BenchRow::rays)) {
        BarSeries series{kind, {}};
        for (const std::string& mesh : plot.groups) {
            const auto r = ratio_to(rows, {mesh, accel, kind, "single"}, base);
            series.bars.push_back(r ? std::optional(Ranged{r->value, r->low, r->high}) : std::nullopt);
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

BarPlot mesh_plot(const BenchRows& rows, const std::string& mesh)
{
    BarPlot plot{{mesh + ": rays per second, one at a time",
                  "Bars for each kind of ray: millions of rays per second of each accelerator on one thread. Whiskers: "
                  "least and largest of the rounds.",
                  "kind of ray", "Mrays/s"},
                 Scale::linear,
                 distinct(rows, &BenchRow::rays),
                 {},
                 {}};
    for (const std::string& accel : plotted(where(rows, &BenchRow::way, "single"))) {
        BarSeries series{accel, {}};
        for (const std::string& kind : plot.groups) {
            const BenchRow* row = find_row(rows, {mesh, accel, kind, "single"});
            series.bars.push_back(row ? std::optional(row->mega_per_second()) : std::nullopt);
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

// Of the closed meshes that a watertightness campaign asked, the worst: "0 / 0 / 0". Empty if it asked none. The
// accelerator "embree" has the trees of Embree robust.
std::string misses_text(const BenchRows& all, const std::string& name, bool& any)
{
    const std::string accel = name == robust_embree ? "embree" : name;
    std::string text;
    for (const char* key : {"misses_random", "misses_edge", "misses_vertex"}) {
        std::optional<double> worst;
        for (const BenchRow* row : all)
            if (const auto x = row->accel == accel ? row->number(key) : std::nullopt)
                worst = std::max(worst.value_or(0), *x);
        if (!worst) return "";
        any |= *worst > 0;
        text += (text.empty() ? "" : " / ") + count_text(*worst);
    }
    return text;
}

std::string speed_text(const BenchRow& row)
{
    std::string text = ranged_cell(row.mega_per_second()).text;
    if (const auto r = row.speed_ratio()) text += "\n" + ratio_text(*r);
    if (const auto wrong = row.number("disagreements")) text += "\nwrong: " + count_text(*wrong);
    return text;
}

Table mesh_table(const BenchRows& rows, const BenchRows& all)
{
    const std::vector<std::string> kinds = distinct(rows, &BenchRow::rays);
    Table table{
        "Mrays/s: median [least .. largest]; times " + robust_embree +
            ", singly; wrong answers per 1e6 rays. Misses: per 1e6 rays from inside closed meshes, the worst of them.",
        {"accelerator", "way"},
        {}};
    table.head.insert(table.head.end(), kinds.begin(), kinds.end());
    table.head.emplace_back("misses random / edge / vertex");
    for (const std::string& accel : distinct(rows, &BenchRow::accel)) {
        const BenchRows of_accel = where(rows, &BenchRow::accel, accel);
        bool leaks = false;
        const std::string misses = misses_text(all, accel, leaks);
        for (const std::string& way : distinct(of_accel, &BenchRow::way)) {
            std::vector<Cell> cells{text_cell(accel), text_cell(way)};
            for (const std::string& kind : kinds) {
                const BenchRow* row = find_row(of_accel, {"", "", kind, way});
                const bool wrong = row && row->number("disagreements").value_or(0) > 0;
                cells.push_back({row ? speed_text(*row) : "", true, wrong ? Tone::bad : Tone::plain});
            }
            cells.push_back({misses, true, leaks ? Tone::bad : Tone::plain});
            table.rows.push_back(std::move(cells));
        }
    }
    return table;
}

Section glance_section(const BenchRows& rows)
{
    Section section{"Speed at a glance", {}};
    section.blocks.push_back(
        Paragraph{"Every ratio is of times that were taken in turns: the median over the rounds, with the least and "
                  "the largest in brackets. Above 1 the accelerator is faster."});
    section.blocks.push_back(Plot{to_svg(ladder_plot(rows))});
    const std::string fastest = fastest_own(rows);
    for (const std::string& base : {robust_embree, fast_embree}) {
        if (!find_row(rows, {"", base, "", "single"})) continue;
        if (!fastest.empty()) section.blocks.push_back(Plot{to_svg(kinds_plot(rows, fastest, base))});
        section.blocks.push_back(glance_table(rows, base));
    }
    return section;
}

Table build_table(const BenchRows& rows)
{
    Table table{"Building: seconds, median [least .. largest], and what came of it",
                {"accelerator", "threads", "seconds", "speed against the first", "Mtriangles/s", "bytes per triangle",
                 "SAH cost"},
                {}};
    for (const BenchRow* row : rows) {
        Ranged seconds;
        if (const auto x = row->number("build_seconds")) seconds.value = *x;
        if (const auto x = row->number("min")) seconds.low = *x * 1e-9;
        if (const auto x = row->number("max")) seconds.high = *x * 1e-9;
        const auto rate = row->number("triangles_per_second");
        const auto ratio = row->speed_ratio();
        table.rows.push_back({text_cell(row->accel),
                              count_cell(row->number("threads")),
                              ranged_cell(seconds),
                              {ratio ? ratio_text(*ratio) : "", true},
                              number_cell(rate ? *rate / 1e6 : NAN),
                              number_cell(row->number("bytes_per_triangle")),
                              number_cell(row->number("sah_cost"))});
    }
    return table;
}

// Against the first; with as many threads as there were.
BarPlot build_plot(const BenchRows& rows)
{
    double most = 0;
    for (const BenchRow* row : rows) most = std::max(most, row->number("threads").value_or(1));
    const std::string first = rows.front()->accel;
    BarPlot plot{{"Building with " + count_text(most) + (most == 1 ? " thread" : " threads"),
                  "Bars for each mesh: how many times as fast as " + first +
                      " each accelerator is built. Whiskers: least and largest of the rounds.",
                  "mesh", "times " + first},
                 Scale::logarithmic,
                 distinct(rows, &BenchRow::mesh),
                 {},
                 {{1, first}},
                 1};
    for (const std::string& accel : plotted(rows)) {
        BarSeries series{accel, std::vector<std::optional<Ranged>>(plot.groups.size())};
        for (const BenchRow* row : where(rows, &BenchRow::accel, accel)) {
            const auto ratio = row->speed_ratio();
            if (row->number("threads").value_or(1) != most || !ratio) continue;
            const auto group = std::find(plot.groups.begin(), plot.groups.end(), row->mesh) - plot.groups.begin();
            series.bars[static_cast<size_t>(group)] = Ranged{ratio->value, ratio->low, ratio->high};
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

}  // namespace

std::vector<Section> speed_sections(const std::vector<BenchFile>& files)
{
    const BenchRows rows = rows_of(files, "accel"), all = rows_of(files, "");
    if (rows.empty()) return {};
    std::vector<Section> sections{glance_section(rows)};
    for (const std::string& mesh : distinct(rows, &BenchRow::mesh)) {
        const BenchRows of_mesh = where(rows, &BenchRow::mesh, mesh);
        sections.push_back(
            {"Speed: " + mesh, {Plot{to_svg(mesh_plot(of_mesh, mesh))}, mesh_table(of_mesh, all)}, true});
    }
    return sections;
}

std::vector<Section> build_sections(const std::vector<BenchFile>& files)
{
    const BenchRows rows = rows_of(files, "build");
    if (rows.empty()) return {};
    Section section{"Building", {Plot{to_svg(build_plot(rows))}}};
    for (const std::string& mesh : distinct(rows, &BenchRow::mesh)) {
        const BenchRows of_mesh = where(rows, &BenchRow::mesh, mesh);
        Table table = build_table(of_mesh);
        const auto triangles = of_mesh.front()->number("triangles");
        table.caption = mesh + (triangles ? ", " + count_text(*triangles) + " triangles. " : ". ") + table.caption;
        section.blocks.push_back(std::move(table));
    }
    return {section};
}

}  // namespace lancer
