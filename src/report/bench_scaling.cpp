#include "report/bench_scaling.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/bench_cells.h"

namespace lancer {
namespace {

// What grows, the first that a row has: a scene of many lights or instances has triangles too.
constexpr std::array sizes{"lights", "instances", "triangles"};

std::string size_of(const BenchRow& row)
{
    for (const char* size : sizes)
        if (row.number(size)) return size;
    return "";
}

struct Quantity {
    const char* title;
    const char* unit;
    Ranged (*of)(const BenchRow&);
};

Ranged field(const BenchRow& row, const char* name)
{
    Ranged r;
    if (const auto x = row.number(name)) r.value = *x;
    return r;
}

constexpr std::array quantities{
    Quantity{"speed", "millions per second",
             [](const BenchRow& row) { return row.number("build_seconds") ? Ranged{} : row.mega_per_second(); }},
    Quantity{"build time", "seconds", [](const BenchRow& row) { return field(row, "build_seconds"); }},
    Quantity{"memory", "bytes", [](const BenchRow& row) { return field(row, "bytes"); }},
};

// A curve for each accelerator; rows without the quantity are another plot's.
LinePlot growth_plot(const BenchRows& rows, const std::string& size, const std::string& what, const Quantity& quantity)
{
    LinePlot plot{{what + ": " + quantity.title,
                   std::string("Curves for each accelerator: ") + quantity.title + " against the number of " + size +
                       ", both by powers of ten.",
                   size, quantity.unit},
                  Scale::logarithmic,
                  Scale::logarithmic,
                  {},
                  {}};
    for (const std::string& accel : distinct(rows, &BenchRow::accel)) {
        PlotSeries series{accel, {}, Look::line};
        for (const BenchRow* row : where(rows, &BenchRow::accel, accel)) {
            const Ranged value = quantity.of(*row);
            if (!std::isnan(value.value)) series.points.push_back({*row->number(size), value});
        }
        std::stable_sort(series.points.begin(), series.points.end(),
                         [](const auto& a, const auto& b) { return a.x < b.x; });
        if (series.points.size() > 1) plot.series.push_back(std::move(series));
    }
    return plot;
}

// One plot for each mesh, kind of ray and quantity that has a curve.
void add_plots(const BenchRows& rows, const std::string& size, std::vector<Block>& blocks)
{
    for (const std::string& mesh : distinct(rows, &BenchRow::mesh)) {
        const BenchRows of_mesh = where(rows, &BenchRow::mesh, mesh);
        std::vector<std::string> kinds = distinct(of_mesh, &BenchRow::rays);
        kinds.emplace_back();  // rows about no kind
        for (const std::string& kind : kinds) {
            const BenchRows of_kind = where(of_mesh, &BenchRow::rays, kind);
            for (const Quantity& quantity : quantities) {
                const LinePlot plot = growth_plot(of_kind, size, mesh + (kind.empty() ? "" : ", " + kind), quantity);
                if (!plot.series.empty()) blocks.emplace_back(Plot{to_svg(plot)});
            }
        }
    }
}

Table exponent_table(const BenchRows& rows)
{
    Table table{"Exponents: value ~ size^exponent, with an interval of 95 %",
                {"what", "mesh", "accelerator", "rays", "exponent"},
                {}};
    for (const BenchRow* row : rows) {
        Ranged r = field(*row, "exponent");
        r.low = field(*row, "exponent_low").value, r.high = field(*row, "exponent_high").value;
        table.rows.push_back({text_cell(row->name.substr(row->name.find('/') + 1)), text_cell(row->mesh),
                              text_cell(row->accel), text_cell(row->rays), ranged_cell(r)});
    }
    return table;
}

}  // namespace

std::vector<Section> scaling_sections(const std::vector<BenchFile>& files)
{
    BenchRows points, fits;
    for (const BenchRow* row : rows_of(files, "scaling")) (row->number("exponent") ? fits : points).push_back(row);
    if (points.empty() && fits.empty()) return {};
    Section section{"Growth", {}};
    if (!fits.empty()) section.blocks.emplace_back(exponent_table(fits));
    for (const char* size : sizes) {
        BenchRows of_size;
        for (const BenchRow* row : points)
            if (size_of(*row) == size) of_size.push_back(row);
        add_plots(of_size, size, section.blocks);
    }
    section.blocks.emplace_back(table_of(points, "All sizes"));
    return {section};
}

}  // namespace lancer
