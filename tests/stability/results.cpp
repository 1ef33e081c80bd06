#include "stability/results.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/parallel.h"
#include "report/number_text.h"
#include "report/svg_plot.h"

namespace lancer::stability {
namespace {

std::string bound_text(const Measure& m)
{
    if (!m.judged) return "";
    const std::string bound = significant(m.threshold);
    return m.bound == Bound::at_most ? "≤ " + bound : m.bound == Bound::at_least ? "≥ " + bound : "= " + bound;
}

std::string margin_text(const Measure& m)
{
    if (!m.judged || m.bound == Bound::exactly) return "";
    return std::isinf(m.margin()) ? "∞" : significant(m.margin(), 2);
}

std::string count_or_number(double x)
{
    return std::abs(x) < 1e15 && x == std::floor(x) ? count_text(x) : significant(x);
}

// A row's figures, one line each, in as many table rows.
void add_rows(Table& table, const Result& r)
{
    const Cell verdict{!r.judged    ? "told"
                       : r.passes() ? "pass"
                                    : "FAIL",
                       false,
                       !r.judged    ? Tone::plain
                       : r.passes() ? Tone::good
                                    : Tone::bad};
    std::vector<Cell> cells{{r.id}, {r.stiff}, {r.reference}, {r.accelerator}};
    const auto finish = [&] {
        cells.insert(cells.end(), {verdict,
                                   {significant(r.seconds, 2), true},
                                   {count_text(static_cast<double>(r.outcome.dropped)), true},
                                   {count_text(static_cast<double>(r.outcome.rejected)), true}});
        table.rows.push_back(std::move(cells));
        cells = {{""}, {""}, {""}, {""}};
    };
    if (!r.problem.empty()) {
        cells.insert(cells.end(), {{r.problem, false, Tone::bad}, {""}, {""}, {""}});
        finish();
    }
    bool first = r.problem.empty();
    for (const Measure& m : r.outcome.measures) {
        const Tone tone = m.judged && r.judged && !m.passes() ? Tone::bad : Tone::plain;
        cells.insert(
            cells.end(),
            {{m.what, false, tone}, {count_or_number(m.value), true, tone}, {bound_text(m)}, {margin_text(m), true}});
        if (first) {
            finish();
            first = false;
        } else {
            table.rows.push_back(std::move(cells));
            cells = {{""}, {""}, {""}, {""}};
        }
    }
}

std::string drops_text(const SampleCount& count)
{
    std::string text = count_text(static_cast<double>(count.dropped)) + " of " +
                       significant(static_cast<double>(count.samples), 4) + " samples were dropped as not finite";
    if (const auto bound = count.chance_below())
        text += "; the chance of one is below " + significant(*bound, 2) + " with 95 % confidence";
    return text + ".";
}

Plot plot_of(const Sweep& sweep)
{
    LinePlot plot{{sweep.title, "", sweep.x, sweep.y}, Scale::logarithmic, Scale::logarithmic, {}, {}};
    for (const SweepCurve& curve : sweep.curves) {
        PlotSeries series{curve.name, {}};
        for (const SweepPoint& p : curve.points) series.points.push_back({p.x, {p.error}});
        plot.labels.description += curve.name + (&curve == &sweep.curves.back() ? "." : ", ");
        plot.series.push_back(std::move(series));
    }
    plot.labels.description = sweep.y + " against " + sweep.x + ": " + plot.labels.description;
    return {to_svg(plot)};
}

}  // namespace

bool Result::passes() const
{
    return problem.empty() && outcome.dropped == 0 &&
           std::all_of(outcome.measures.begin(), outcome.measures.end(), [](const Measure& m) { return m.passes(); });
}

std::optional<double> SampleCount::chance_below() const
{
    if (samples == 0 || dropped > 0) return {};
    return 3 / static_cast<double>(samples);
}

SampleCount count_samples(const std::vector<Result>& results)
{
    SampleCount all;
    for (const Result& r : results)
        if (r.judged) all += {r.outcome.samples, r.outcome.dropped};
    return all;
}

Result run_row(const Row& row, const Setup& setup, unsigned threads)
{
    Result result{row.id, row.stiff, row.reference, row.rays ? setup.accelerator : "", !setup.fast(), "", {}, 0};
    const auto start = std::chrono::steady_clock::now();
    try {
        const auto run = [&] { result.outcome = row.run(setup); };
        if (row.own_threads)
            run();
        else
            with_threads(threads, run);
        if (result.outcome.measures.empty()) result.problem = "nothing was measured";
    } catch (const std::exception& e) {
        result.problem = e.what();
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

Document make_page(const std::vector<Result>& results, const std::vector<Sweep>& sweeps, const std::string& tier,
                   const std::optional<SampleCount>& all_runs)
{
    size_t judged = 0, failed = 0;
    for (const Result& r : results) judged += r.judged, failed += r.judged && !r.passes();
    Document page{"Stability matrix, tier " + tier, {}, {}};
    page.opening.push_back(Paragraph{
        count_text(static_cast<double>(judged - failed)) + " of " + count_text(static_cast<double>(judged)) + " pass",
        failed == 0 ? Tone::plain : Tone::bad});
    const SampleCount here = count_samples(results);
    if (here.samples > 0) page.opening.push_back(Paragraph{"Here " + drops_text(here)});
    if (all_runs) page.opening.push_back(Paragraph{"In all full runs so far " + drops_text(*all_runs)});
    Table table{"",
                {"id", "what is stiff about it", "compared to", "accelerator", "measure", "value", "may be", "margin",
                 "verdict", "s", "dropped", "rays rejected"},
                {}};
    for (const Result& r : results) add_rows(table, r);
    page.sections.push_back({"Rows", {table}, false});
    if (!sweeps.empty()) {
        Section plots{"Error against stiffness", {}, true};
        for (const Sweep& sweep : sweeps) plots.blocks.push_back(plot_of(sweep));
        page.sections.push_back(std::move(plots));
    }
    return page;
}

std::string to_json(const std::vector<Result>& results, const std::string& tier)
{
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Result& r : results) {
        nlohmann::ordered_json measures = nlohmann::ordered_json::array();
        for (const Measure& m : r.outcome.measures) {
            nlohmann::ordered_json measure{{"what", m.what}, {"value", m.value}};
            if (m.judged)
                measure.update({{"bound", m.bound == Bound::at_most    ? "at_most"
                                          : m.bound == Bound::at_least ? "at_least"
                                                                       : "exactly"},
                                {"threshold", m.threshold},
                                {"pass", m.passes()}});
            measures.push_back(std::move(measure));
        }
        rows.push_back({{"id", r.id},
                        {"stiff", r.stiff},
                        {"reference", r.reference},
                        {"accelerator", r.accelerator},
                        {"judged", r.judged},
                        {"pass", r.passes()},
                        {"problem", r.problem},
                        {"seconds", r.seconds},
                        {"samples", r.outcome.samples},
                        {"dropped", r.outcome.dropped},
                        {"rejected_rays", r.outcome.rejected},
                        {"measures", std::move(measures)}});
    }
    return nlohmann::ordered_json{{"tier", tier}, {"rows", std::move(rows)}}.dump(1) + "\n";
}

}  // namespace lancer::stability
