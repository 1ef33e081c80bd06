#include "report/bench/bench_page.h"

#include <algorithm>

#include "report/bench/tables.h"
#include "report/page/number_text.h"
#include "report/page/svg_plot.h"

namespace lancer {
namespace {

std::string of_threads(unsigned threads) { return threads == 1 ? "one thread" : std::to_string(threads) + " threads"; }

std::vector<unsigned> threads_of(const BenchRun& run)
{
    std::vector<unsigned> all;
    for (const BenchFigure& f : run.figures)
        if (std::find(all.begin(), all.end(), f.threads) == all.end()) all.push_back(f.threads);
    std::sort(all.begin(), all.end());
    return all;
}

// A series for each method, a group for each of the figures that `like` gives.
BarPlot bars_of(const BenchRun& run, const PlotLabels& labels, const std::vector<std::string>& groups,
                const std::vector<BenchFigure>& like)
{
    BarPlot plot{labels, Scale::linear, groups, {}, {}};
    for (const std::string& method : run.methods) {
        BarSeries series{method, {}};
        for (const BenchFigure& figure : like) {
            const BenchFigure* f = run.find(figure, method);
            series.bars.push_back(f ? std::optional(f->value()) : std::nullopt);
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

bool is_empty(const BarPlot& plot)
{
    return std::all_of(plot.series.begin(), plot.series.end(), [](const BarSeries& s) {
        return std::none_of(s.bars.begin(), s.bars.end(), [](const auto& bar) { return bar.has_value(); });
    });
}

void add_plot(const BarPlot& plot, std::vector<Block>& blocks)
{
    if (!is_empty(plot)) blocks.emplace_back(Plot{to_svg(plot)});
}

Section speed_bars(const BenchRun& run)
{
    Section section{"Speed of rays", {Paragraph{"Million rays per second, with 95 % intervals; higher is better."}}};
    for (const unsigned threads : threads_of(run))
        for (const std::string way : {"single", "batch"}) {
            std::vector<std::string> kinds;
            std::vector<BenchFigure> like;
            for (const auto& [kind, hash] : run.rays) {
                kinds.push_back(kind);
                like.push_back({.family = "rays", .accel = {}, .rays = kind, .way = way, .threads = threads});
            }
            const std::string how = std::string(way == "single" ? "singly" : "in batches") + ", " + of_threads(threads);
            add_plot(bars_of(run,
                             {"Rays asked " + how,
                              "A group of bars for each kind of ray, a bar for each method: million rays per second.",
                              "", "million rays per second"},
                             kinds, like),
                     section.blocks);
        }
    return section;
}

Section cost_bars(const BenchRun& run)
{
    Section section{"Building and whole pictures",
                    {Paragraph{"Seconds, with 95 % intervals; lower is better. A picture is drawn until the root of "
                               "its relative mean squared error is " +
                               significant(run.picture_error, 2) + "."}}};
    for (const auto& [family, title] :
         {std::pair{"build", "Building"}, std::pair{"picture", "A picture to the same error"}}) {
        std::vector<std::string> groups;
        std::vector<BenchFigure> like;
        for (const unsigned threads : threads_of(run)) {
            groups.push_back(of_threads(threads));
            like.push_back({.family = family, .accel = {}, .rays = {}, .way = {}, .threads = threads});
        }
        add_plot(bars_of(run,
                         {title, "A group of bars for each number of threads, a bar for each method: seconds.", "",
                          "seconds"},
                         groups, like),
                 section.blocks);
    }
    return section;
}

std::vector<Block> against_blocks(const BenchAgainst& against)
{
    std::vector<Block> blocks{Paragraph{verdict_of(against) + "."}};
    for (const std::string& remark : against.remarks) blocks.emplace_back(Paragraph{remark, Tone::bad});
    blocks.emplace_back(against_table(against, true));
    return blocks;
}

}  // namespace

Document make_page(const BenchRun& run, const BenchAgainst* against)
{
    Document page{"lancer bench: " + run.mesh,
                  {Paragraph{"Speeds of methods on the same rays, interleaved in rounds. × is the speed over that of " +
                             run.baseline +
                             " within the same round, above 1 is faster; brackets hold 95 % intervals. Wrong answers "
                             "are checked against a list of all triangles in double precision."}},
                  {}};
    if (run.interrupted) page.opening.push_back(Paragraph{"Interrupted: fewer rounds than asked for.", Tone::bad});
    page.sections.push_back({"Figures", {figures_table(run, true)}});
    page.sections.push_back(speed_bars(run));
    page.sections.push_back(cost_bars(run));
    if (against) page.sections.push_back({"Against an earlier run", against_blocks(*against)});
    page.sections.push_back({"Mesh and machine", {run_table(run)}});
    page.sections.push_back({"Raw data", {JsonData{"bench", to_json(run)}}});
    return page;
}

}  // namespace lancer
