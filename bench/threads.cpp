// bench_threads: how much sooner several threads have a picture than one, beside what the machine allows: as many
// renders at once, of one thread each, that have nothing to do with one another.
#include <thread>

#include "app/console.h"
#include "core/lanes/denormals.h"
#include "core/parallel.h"
#include "harness/scenes.h"
#include "harness/stage.h"

namespace lancer::bench {
namespace {

void draw(const Stage& stage, uint32_t spp, unsigned threads)
{
    with_threads(threads, [&] { stage.draw(spp); });
}

void draw_apart(const Stage& stage, uint32_t spp, unsigned renders)
{
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < renders; ++i)
        threads.emplace_back([&] {
            set_flush_denormals();
            draw(stage, spp, 1);
        });
}

void measure_scene(const BenchScene& scene, const Options& options, Report& report)
{
    const Stage stage(scene.load(), scene.options(options.full ? 384 : 192));
    const uint32_t spp = samples_per_block;
    const unsigned all = available_threads();
    const double samples = static_cast<double>(stage.settings.size.width) * stage.settings.size.height * spp;
    std::vector<unsigned> threads{1, all, all};  // of each contestant
    std::vector<Contestant> contestants{{"one", samples, [&] { draw(stage, spp, 1); }},
                                        {"all", samples, [&] { draw(stage, spp, all); }},
                                        {"apart", all * samples, [&] { draw_apart(stage, spp, all); }}};
    if (options.threads > all) {
        threads.push_back(options.threads);
        contestants.push_back({"crowd", samples, [&] { draw(stage, spp, options.threads); }});
    }
    const std::vector<Timing> timings = take_turns(contestants, options.repetitions, all);
    for (size_t i = 0; i < contestants.size(); ++i) {
        Json& row = report.add("threads", joined({scene.name, contestants[i].name}), timings[i], all);
        row["threads"] = threads[i];
        row["mesh"] = scene.name, row["accel"] = std::string(name_of(stage.renderer.accelerator_kind())),
        row["way"] = contestants[i].name;
        add_ratio(row, contestants[0].name, timings[0], timings[i], all);
        print_row(row);
    }
}

}  // namespace
}  // namespace lancer::bench

int main(int argc, char** argv)
{
    using namespace lancer::bench;
    return run_program(
        argc, argv, "bench_threads",
        "Draws scenes with one thread, with one for each CPU (all), as many times at once as there are CPUs with one "
        "thread each (apart), and with as many threads as -t says where these are more than CPUs (crowd).\nRatios are "
        "speeds on the clock, of all samples together, against one thread; that of apart is what the machine allows.",
        [](const Options& options, Report& report) {
            for (const BenchScene& scene : choose_scenes(options)) measure_scene(scene, options, report);
        });
}
