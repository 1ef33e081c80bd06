// The matrix as a document: an overview by group, the rows of each group, the sweeps as plots.
#include <algorithm>
#include <array>
#include <cmath>

#include "report/page/number_text.h"
#include "report/page/svg_plot.h"
#include "stability/results.h"

namespace lancer::stability {
namespace {

struct Group {
    char letter;
    const char* name;
};
constexpr std::array groups{Group{'N', "Scale and place"},
                            Group{'G', "Bad geometry"},
                            Group{'R', "Rays"},
                            Group{'P', "Spheres and planes"},
                            Group{'D', "Dielectric, mirror, glossy"},
                            Group{'L', "Light"},
                            Group{'A', "Film and sampling"},
                            Group{'C', "Camera and command line"},
                            Group{'M', "Materials"},
                            Group{'S', "Scenes that come with lancer"}};

std::vector<const Result*> of_group(const std::vector<Result>& results, char letter)
{
    std::vector<const Result*> found;
    for (const Result& r : results)
        if (r.id[0] == letter) found.push_back(&r);
    return found;
}

std::string value_text(double x)
{
    if (!std::isfinite(x)) return std::isnan(x) ? "NaN" : x > 0 ? "∞" : "-∞";
    return std::abs(x) < 1e15 && x == std::floor(x) ? count_text(x) : significant(x);
}

std::string bound_text(const Measure& m)
{
    if (!m.judged) return "";
    const char* const sign = m.bound == Bound::at_most ? "≤" : m.bound == Bound::at_least ? "≥" : "=";
    return sign + std::string("\u00a0") + round_text(m.threshold);
}

std::string margin_text(double margin) { return std::isinf(margin) ? "∞" : significant(margin, 2); }

std::string verdict_of(const Result& r) { return !r.judged ? "told" : r.passes() ? "pass" : "FAIL"; }

Cell number(std::string text, Tone tone = Tone::plain) { return {std::move(text), true, tone}; }

std::string count_text_of(uint64_t n) { return count_text(static_cast<double>(n)); }

// The rows of a group, a line for each of their figures.
Table table_of(const std::vector<const Result*>& results)
{
    const auto any = [&](const auto& f) { return std::any_of(results.begin(), results.end(), f); };
    const bool by_accelerator = any([](const Result* r) { return !r->accelerator.empty(); });
    const bool drops = any([](const Result* r) { return r->outcome.dropped > 0; });
    const bool rejects = any([](const Result* r) { return r->outcome.rejected > 0; });
    Table table;
    table.head = {"id", "what is stiff about it, compared to what"};
    if (by_accelerator) table.head.emplace_back("accelerator");
    table.head.insert(table.head.end(), {"", "s", "measure", "value", "may be", "margin"});
    if (drops) table.head.emplace_back("dropped");
    if (rejects) table.head.emplace_back("rays rejected");
    std::string last;
    for (const Result* r : results) {
        const Tone tone = !r->judged ? Tone::plain : r->passes() ? Tone::good : Tone::bad;
        // What the accelerators have in common is said once.
        std::vector<Cell> start{{r->id == last ? "" : r->id},
                                {r->id == last ? "" : r->stiff + "\nto: " + r->reference}};
        last = r->id;
        if (by_accelerator) start.push_back({r->accelerator});
        start.insert(start.end(), {{verdict_of(*r), false, tone}, number(significant(r->seconds, 2))});
        const size_t before = start.size();
        bool first = true;
        const auto add = [&](std::vector<Cell> figure) {
            std::vector<Cell> line = first ? start : std::vector<Cell>(before);
            line.insert(line.end(), figure.begin(), figure.end());
            if (first && drops) line.push_back(number(count_text_of(r->outcome.dropped)));
            if (first && rejects) line.push_back(number(count_text_of(r->outcome.rejected)));
            table.rows.push_back(std::move(line));
            first = false;
        };
        if (!r->problem.empty()) add({{r->problem, false, Tone::bad}, {}, {}, {}});
        for (const Measure& m : r->outcome.measures) {
            const bool is_bad = m.judged && r->judged && !m.passes();
            const bool has_margin = m.judged && m.bound != Bound::exactly;
            add({{m.what, false, is_bad ? Tone::bad : Tone::plain},
                 number(value_text(m.value), is_bad ? Tone::bad : Tone::plain),
                 {bound_text(m)},
                 number(has_margin ? margin_text(m.margin()) : "")});
        }
    }
    return table;
}

// A line for each group: how many passed, and the figure that came nearest to what it may be.
Table overview(const std::vector<Result>& results)
{
    Table table{"", {"group", "rows", "passed", "failed", "s", "least margin", "of"}, {}};
    for (const Group& group : groups) {
        const std::vector<const Result*> rows = of_group(results, group.letter);
        if (rows.empty()) continue;
        uint64_t judged = 0, passed = 0;
        double seconds = 0, margin = INFINITY;
        std::string of;
        for (const Result* r : rows) {
            seconds += r->seconds;
            if (!r->judged) continue;
            ++judged, passed += r->passes();
            for (const Measure& m : r->outcome.measures)
                if (m.judged && m.bound != Bound::exactly && m.margin() < margin)
                    margin = m.margin(), of = r->id + ": " + m.what;
        }
        const Tone tone = passed < judged ? Tone::bad : Tone::plain;
        table.rows.push_back({{std::string(1, group.letter) + ": " + group.name},
                              number(count_text_of(judged)),
                              number(count_text_of(passed)),
                              number(count_text_of(judged - passed), tone),
                              number(significant(seconds, 2)),
                              number(margin_text(margin)),
                              {of}});
    }
    return table;
}

std::string drops_text(const SampleCount& count)
{
    return count_text_of(count.dropped) + " of " + significant(static_cast<double>(count.samples), 4) +
           " samples were dropped as not finite";
}

// Errors of 0 have no place on a logarithmic axis: they are drawn as half a unit in the last place of a double.
Plot plot_of(const Sweep& sweep)
{
    constexpr double nothing = 0x1p-53;
    LinePlot plot{{sweep.title, sweep.y + " against " + sweep.x + ": ", sweep.x, sweep.y},
                  Scale::logarithmic,
                  Scale::logarithmic,
                  {},
                  {}};
    for (const SweepCurve& curve : sweep.curves) {
        PlotSeries series{curve.name, {}};
        bool has_none = false;
        for (const SweepPoint& p : curve.points) {
            has_none = has_none || p.error == 0;
            series.points.push_back({p.x, {p.error == 0 ? nothing : p.error}});
        }
        if (has_none) series.name += " (0 drawn as 1e-16)";
        plot.labels.description += curve.name + (&curve == &sweep.curves.back() ? "." : ", ");
        plot.series.push_back(std::move(series));
    }
    return {to_svg(plot)};
}

}  // namespace

Document make_page(const std::vector<Result>& results, const std::vector<Sweep>& sweeps, const std::string& tier,
                   const std::optional<SampleCount>& all_runs)
{
    uint64_t judged = 0, failed = 0;
    std::string names;
    for (const Result& r : results) {
        if (!r.judged) continue;
        ++judged;
        if (r.passes()) continue;
        ++failed;
        names += (names.empty() ? ": " : ", ") + r.id + (r.accelerator.empty() ? "" : " with " + r.accelerator);
    }
    Document page{"Stability matrix, tier " + tier, {}, {}};
    page.opening.push_back(Paragraph{count_text_of(judged - failed) + " of " + count_text_of(judged) + " passed."});
    if (failed > 0) page.opening.push_back(Paragraph{"Failed" + names + ".", Tone::bad});
    const SampleCount here = count_samples(results);
    if (here.samples > 0) {
        const auto bound = here.chance_below();
        page.opening.push_back(Paragraph{
            "In this run " + drops_text(here) +
            (bound ? "; the chance of one is below " + significant(*bound, 2) + " with 95 % confidence." : ".")});
    }
    // Without a bound: runs have the same seeds.
    if (all_runs && all_runs->samples > here.samples)
        page.opening.push_back(Paragraph{"In all full runs so far " + drops_text(*all_runs) + "."});
    page.opening.push_back(overview(results));
    for (const Group& group : groups)
        if (const auto rows = of_group(results, group.letter); !rows.empty())
            page.sections.push_back({std::string(1, group.letter) + ": " + group.name, {table_of(rows)}, false});
    if (!sweeps.empty()) {
        Section plots{"Error against stiffness", {}, true};
        for (const Sweep& sweep : sweeps) plots.blocks.push_back(plot_of(sweep));
        page.sections.push_back(std::move(plots));
    }
    return page;
}

}  // namespace lancer::stability
