#include "bench/report/page.h"

#include <algorithm>
#include <array>

#include "bench/report/cells.h"
#include "bench/report/repeat.h"
#include "bench/report/scaling.h"
#include "bench/report/speed.h"
#include "report/page/number_text.h"

namespace lancer {
namespace {

std::string base_name(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

// One row for each thing that is told, one column for each file; files that tell the same share one.
Table machine_table(const std::vector<BenchFile>& files)
{
    using Lines = std::vector<std::string>;
    const auto lines_of = [](const MachineBlock& m) {
        const auto number = [](const auto& x) { return x ? count_text(*x) : ""; };
        return Lines{m.cpu,
                     number(m.num_cpus),
                     number(m.threads),
                     m.compiler,
                     m.flags,
                     m.embree,
                     m.embree_isa,
                     m.embree_asserts ? (*m.embree_asserts ? "on" : "off") : "",
                     m.tbb,
                     m.lancer};
    };
    static constexpr std::array names{
        "CPU", "CPUs",  "threads", "compiler", "flags", "Embree", "instruction set of Embree", "assertions in Embree",
        "TBB", "lancer"};
    std::vector<std::pair<Lines, std::string>> columns;
    for (const BenchFile& file : files) {
        const Lines lines = lines_of(file.machine);
        const auto same = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.first == lines; });
        if (same != columns.end())
            same->second += ", " + base_name(file.name);
        else
            columns.emplace_back(lines, base_name(file.name));
    }
    Table table{"The machine", {""}, {}};
    for (const auto& [lines, name] : columns) table.head.push_back(columns.size() == 1 ? "all files" : name);
    for (size_t i = 0; i < names.size(); ++i) {
        std::vector<Cell> cells{text_cell(names[i])};
        for (const auto& [lines, name] : columns) cells.push_back(text_cell(lines[i].empty() ? "not told" : lines[i]));
        table.rows.push_back(std::move(cells));
    }
    return table;
}

Table files_table(const std::vector<BenchFile>& files)
{
    Table table{"The files", {"file", "program", "began", "load", "rows"}, {}};
    for (const BenchFile& file : files) {
        const MachineBlock& m = file.machine;
        const bool busy = !unfit(m).empty();
        table.rows.push_back({text_cell(base_name(file.name)),
                              text_cell(base_name(m.executable)),
                              text_cell(m.date),
                              {m.load ? significant(*m.load) : "not told", true, busy ? Tone::bad : Tone::plain},
                              count_cell(static_cast<double>(file.rows.size()))});
    }
    return table;
}

// Families that are shown as they are.
struct Plain {
    const char* family;
    const char* heading;
    const char* words;
};
constexpr std::array plain_families{
    Plain{"limit", "The limit of a render",
          "The share of a render's time inside the accelerator, clocked while the picture is rendered; the same rays, "
          "recorded and traced again by Embree alone; and a minimal path tracer as a lower bound."},
    Plain{"estimators", "Estimators",
          "Pictures by the default and with one estimator switched. gain: error times time with the switch over that "
          "of the default; above 1 the default is better. error ratio: the same of the error alone."},
    Plain{"threads", "Threads",
          "Wall-clock speeds against one thread. all: one thread for each CPU; apart: as many independent renders at "
          "once, which is what the machine allows; crowd: many more threads than CPUs."},
    Plain{"render", "Whole pictures", "The same picture with each accelerator."},
    Plain{"features", "Unused features",
          "unseen: the feature is added where no ray meets it, against the general kernel without it. saved: "
          "that kernel against the one that the scene gets. unused: the general kernel without the feature's "
          "code, on a scene that does not use it. Speeds above 1 are what leaving out gains."},
    Plain{"agreement", "Agreement", "Answers against a reference in double precision."},
    Plain{"watertight", "Watertightness", "Rays from inside closed meshes that escape: each one is a miss."},
    Plain{"seam", "Accelerator interface overhead",
          "The cost of the class around Embree against direct calls with the same answers, and of refine, its largest "
          "part."},
};

// How much of a render's time its parts take, for each scene.
BarPlot share_plot(const BenchRows& rows)
{
    BarPlot plot{{"Share of the render's time",
                  "Bars for each scene: the CPU time of each way to do a part of the render's work over that of the "
                  "render itself.",
                  "scene", "share"},
                 Scale::linear,
                 distinct(rows, &BenchRow::mesh),
                 {},
                 {{1, "the render"}}};
    for (const std::string& way : distinct(rows, &BenchRow::way)) {
        BarSeries series{way, {}};
        for (const std::string& scene : plot.groups) {
            const BenchRow* row = find_row(rows, {scene, "", "", way});
            const auto share = row ? row->number("share") : std::nullopt;
            series.bars.push_back(share ? std::optional(Ranged{*share}) : std::nullopt);
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

// How fast whole pictures are drawn, against the first accelerator.
BarPlot pictures_plot(const BenchRows& rows)
{
    const std::string first = rows.front()->accel;
    BarPlot plot{{"Whole pictures",
                  "Bars for each scene: how many times as fast as " + first +
                      " each accelerator draws the picture. Whiskers: least and largest of the rounds.",
                  "scene", "times " + first},
                 Scale::linear,
                 distinct(rows, &BenchRow::mesh),
                 {},
                 {{1, first}}};
    for (const std::string& accel : distinct(rows, &BenchRow::accel)) {
        BarSeries series{accel, {}};
        for (const std::string& scene : plot.groups) {
            const BenchRow* row = find_row(rows, {scene, accel, "", ""});
            const auto r = row ? row->speed_ratio() : std::nullopt;
            series.bars.push_back(r ? std::optional(Ranged{r->value, r->low, r->high}) : std::nullopt);
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

// Of families with a row for each mesh and kind of ray: what is summed over them.
std::vector<std::string> summed_fields(const std::string& family)
{
    if (family == "agreement") return {"rays_traced", "same", "ties", "explained", "wrong", "wrong_any"};
    if (family == "watertight")
        return {"rays_random", "lost_random", "rays_edge", "lost_edge",
                "rays_vertex", "lost_vertex", "rays_axis", "lost_axis"};
    return {};
}

Table totals(const BenchRows& rows, const std::vector<std::string>& fields)
{
    Table table{"All rows of an accelerator together", {"accelerator"}, {}};
    table.head.insert(table.head.end(), fields.begin(), fields.end());
    for (const std::string& accel : distinct(rows, &BenchRow::accel)) {
        std::vector<Cell> cells{text_cell(accel)};
        for (const std::string& field : fields) {
            double sum = 0;
            for (const BenchRow* row : where(rows, &BenchRow::accel, accel)) sum += row->number(field).value_or(0);
            cells.push_back(count_cell(sum));
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

std::vector<Section> plain_section(const std::vector<BenchFile>& files, const Plain& plain)
{
    const BenchRows rows = rows_of(files, plain.family);
    if (rows.empty()) return {};
    if (const auto fields = summed_fields(plain.family); !fields.empty())
        return {{plain.heading, {Paragraph{plain.words}, totals(rows, fields)}},
                {std::string(plain.heading) + ": every mesh", {table_of(rows, "")}, true}};
    Section section{plain.heading, {Paragraph{plain.words}}};
    if (plain.family == std::string("limit")) section.blocks.emplace_back(Plot{to_svg(share_plot(rows))});
    if (plain.family == std::string("render")) section.blocks.emplace_back(Plot{to_svg(pictures_plot(rows))});
    section.blocks.emplace_back(table_of(rows, ""));
    return {section};
}

// What no part of the page knows is not lost.
std::vector<Section> other_sections(const std::vector<BenchFile>& files)
{
    std::vector<Section> sections;
    for (const std::string& family : distinct(rows_of(files, ""), &BenchRow::family)) {
        const bool known = family == "accel" || family == "build" || family == "scaling" ||
                           std::any_of(plain_families.begin(), plain_families.end(),
                                       [&](const Plain& p) { return family == p.family; });
        if (!known) sections.push_back({family, {table_of(rows_of(files, family), "")}});
    }
    return sections;
}

Section data_section(const std::vector<BenchFile>& files)
{
    Section section{
        "Raw data",
        {Paragraph{"Every file stands in this page as it was read, in a script element of type application/json."}},
        true};
    for (size_t i = 0; i < files.size(); ++i)
        section.blocks.push_back(JsonData{"data" + std::to_string(i), files[i].json});
    return section;
}

}  // namespace

std::vector<std::string> verdicts(const std::vector<BenchFile>& files)
{
    Findings findings;
    for (const BenchFile& file : files) {
        findings.add(base_name(file.name), unfit(file.machine));
        MachineBlock first = files.front().machine, block = file.machine;
        first.load = block.load = 0;        // of each file by itself
        first.threads = block.threads = 1;  // what each program is told, not where it runs
        findings.add(base_name(file.name), not_comparable(first, block));
    }
    return findings.lines();
}

Document make_bench_page(const std::vector<BenchFile>& files, const std::vector<BenchFile>& earlier)
{
    Document page{"lancer: benchmarks", {}, {}};
    const std::vector<std::string> reasons = verdicts(files);
    if (reasons.empty())
        page.opening.push_back(Paragraph{
            "Comparable: one machine, one build, load at most " + significant(highest_load, 2) + ".", Tone::good});
    for (const std::string& reason : reasons)
        page.opening.push_back(Paragraph{"Not comparable: " + reason + ".", Tone::bad});
    page.opening.push_back(machine_table(files));
    page.opening.push_back(files_table(files));
    const auto add = [&](std::vector<Section> sections) {
        std::move(sections.begin(), sections.end(), std::back_inserter(page.sections));
    };
    if (!earlier.empty()) page.sections.push_back(repeat_section(earlier, files));
    add(speed_sections(files));
    add(build_sections(files));
    add(scaling_sections(files));
    for (const Plain& plain : plain_families) add(plain_section(files, plain));
    add(other_sections(files));
    page.sections.push_back(data_section(files));
    return page;
}

}  // namespace lancer
