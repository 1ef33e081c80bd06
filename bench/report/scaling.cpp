#include "bench/report/scaling.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/report/cells.h"

namespace lancer {
namespace {

// What grows: a series about lights or instances has their name, all others are meshes of more and more triangles.
std::string growing(const std::string& mesh) { return mesh == "lights" || mesh == "instances" ? mesh : "triangles"; }

Ranged field(const BenchRow& row, const char* name)
{
    Ranged r;
    if (const auto x = row.number(name)) r.value = *x;
    return r;
}

struct Quantity {
    const char* title;
    const char* unit;
    Ranged (*of)(const BenchRow&);
};
constexpr std::array quantities{
    Quantity{"speed", "millions per second", [](const BenchRow& row) { return row.mega_per_second(); }},
    Quantity{"CPU time of building", "seconds", [](const BenchRow& row) { return field(row, "build_seconds"); }},
    Quantity{"memory", "bytes", [](const BenchRow& row) { return field(row, "bytes"); }},
};

// A curve for each accelerator that has the quantity at more than one size.
LinePlot growth_plot(const BenchRows& rows, const std::string& mesh, const std::string& what, const Quantity& quantity)
{
    const std::string grows = growing(mesh), subject = mesh + (what == "build" ? "" : ", " + what);
    LinePlot plot{{subject + ": " + quantity.title,
                   std::string("Curves for each accelerator: ") + quantity.title + " against the number of " + grows +
                       ", both by powers of ten.",
                   grows, quantity.unit},
                  Scale::logarithmic,
                  Scale::logarithmic,
                  {},
                  {}};
    for (const std::string& accel : distinct(rows, &BenchRow::accel)) {
        PlotSeries series{accel, {}, Look::line};
        for (const BenchRow* row : where(rows, &BenchRow::accel, accel)) {
            const Ranged value = quantity.of(*row);
            const auto size = row->number("size");
            if (size && !std::isnan(value.value)) series.points.push_back({*size, value});
        }
        std::stable_sort(series.points.begin(), series.points.end(),
                         [](const auto& a, const auto& b) { return a.x < b.x; });
        if (series.points.size() > 1) plot.series.push_back(std::move(series));
    }
    return plot;
}

void add_plots(const BenchRows& rows, const std::string& mesh, std::vector<Block>& blocks)
{
    std::vector<std::string> whats;
    for (const BenchRow* row : rows)
        if (std::find(whats.begin(), whats.end(), row->text("what")) == whats.end()) whats.push_back(row->text("what"));
    for (const std::string& what : whats) {
        BenchRows of_what;
        for (const BenchRow* row : rows)
            if (row->text("what") == what) of_what.push_back(row);
        for (const Quantity& quantity : quantities) {
            const LinePlot plot = growth_plot(of_what, mesh, what, quantity);
            if (!plot.series.empty()) blocks.emplace_back(Plot{to_svg(plot)});
        }
    }
}

Table exponent_table(const BenchRows& rows)
{
    Table table{"Exponents: value ~ size^exponent, with an interval of 95 %",
                {"mesh", "accelerator", "what", "exponent", "from", "to", "of"},
                {}};
    for (const BenchRow* row : rows) {
        Ranged r = field(*row, "exponent");
        r.low = field(*row, "exponent_low").value, r.high = field(*row, "exponent_high").value;
        table.rows.push_back({text_cell(row->mesh), text_cell(row->accel), text_cell(row->text("what")), ranged_cell(r),
                              count_cell(row->number("from")), count_cell(row->number("to")),
                              text_cell(growing(row->mesh))});
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
    for (const std::string& mesh : distinct(points, &BenchRow::mesh))
        add_plots(where(points, &BenchRow::mesh, mesh), mesh, section.blocks);
    return {section, {"Growth: every size", {table_of(points, "")}, true}};
}

}  // namespace lancer
