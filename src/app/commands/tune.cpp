// lancer tune: what the estimators give on a scene, by small pictures in turns.
#include <string>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/prepare.h"
#include "app/signals.h"
#include "core/names.h"
#include "core/parallel.h"
#include "report/tune.h"

namespace lancer {
namespace {

std::string to_text(const RatioInterval& r)
{
    return format_text("%-22s ", format_text("%.2f [%.2f .. %.2f]", r.median, r.interval.low, r.interval.high).c_str());
}

std::string setting_of(const TuneRow& row) { return std::string(row.option->name) + (row.value ? "=true" : "=false"); }

// Less than this is neither better nor worse.
constexpr double little = 0.02;

std::string verdict_of(const TuneRow& row)
{
    const auto is_below = [](const RatioInterval& r) { return r.interval.high < 1 && r.median < 1 - little; };
    const auto is_above = [](const RatioInterval& r) { return r.interval.low > 1 && r.median > 1 + little; };
    if (is_below(row.mean)) return format_text("misses light: the picture has %.2f of it", row.mean.median);
    if (is_below(row.both)) return "better: --set " + setting_of(row);
    if (is_above(row.both)) return "worse";
    return "no difference shown";
}

void print(const TuneResult& result, const RenderSettings& settings)
{
    if (result.rounds == 0 || result.rows.empty()) {
        print_result("no estimator that can be switched changes this picture");
        return;
    }
    print_result(format_text("%u rounds of %zu pixels of %ux%u with %u samples; time: of the whole picture with %u",
                             result.rounds, size_t{result.pixels}, settings.size.width, settings.size.height,
                             result.spp, settings.spp));
    print_result(format_text("%-24s  %-23s%-23s%-23s", "switched over", "time", "error", "error x time"));
    for (const TuneRow& row : result.rows)
        print_result(format_text("%-24s  ", setting_of(row).c_str()) + to_text(row.time) + to_text(row.error) +
                     to_text(row.both) + verdict_of(row));
}

}  // namespace

int run_tune(int argc, char** argv)
{
    const auto options = parse_tune(argc, argv);
    if (!options) return exit_done;
    Signals signals;
    Diagnostics diagnostics;
    Prepared p = load_prepared(options->picture, diagnostics, true);
    bool interrupted = false;
    with_threads(p.threads, [&] {
        begin_prepared(p, diagnostics);
        p.settings.stop = false;  // pictures of equal samples are compared
        const auto renderer = make_renderer(p, options->picture, usual_batch, diagnostics);
        const TuneResult result = tune(*renderer, *p.description.camera,
                                       {.settings = p.settings,
                                        .grid = pixel_grid(p.settings),
                                        .seconds = options->seconds,
                                        .round_done =
                                            [&](uint32_t rounds) {
                                                if (!options->quiet) print_note(format_text("round %u", rounds));
                                            },
                                        .is_stopped = [&] { return signals.poll(), signals.interrupted(); }});
        interrupted = signals.interrupted();
        if (!interrupted || result.rounds > 0) print(result, p.settings);
    });
    return interrupted ? exit_interrupted : exit_done;
}

}  // namespace lancer
