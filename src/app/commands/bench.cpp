// lancer bench: accelerators beside Embree on a mesh, in rounds within a given time, as a table, files and a page.
#include <filesystem>

#include "app/bench/machine.h"
#include "app/bench/measure.h"
#include "app/commands/commands.h"
#include "app/console.h"
#include "app/signals.h"
#include "app/system_info.h"
#include "core/clock.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "io/input_text.h"
#include "report/bench/bench_page.h"
#include "report/bench/tables.h"
#include "report/page/html.h"
#include "report/page/text_table.h"

namespace lancer {
namespace {

namespace fs = std::filesystem;

constexpr const char* json_name = "bench.json";

// The part of the time that is left for figures, files and the page.
double seconds_for_report(double all) { return std::min(0.5, 0.02 * all); }

BenchRun read_earlier(const std::string& path)
{
    const std::string file = fs::is_directory(path) ? (fs::path(path) / json_name).string() : path;
    return read_bench_run(file, read_input_text(file));
}

// A folder that is new, empty, or of another run. Throws Error.
void take_folder(const std::string& folder)
{
    std::error_code problem;
    if (fs::exists(folder, problem) && !fs::is_directory(folder, problem))
        throw Error(ErrorKind::usage, {}, "--output: " + in_quotes(folder) + " is a file, not a folder");
    if (fs::is_directory(folder, problem) && !fs::is_empty(folder, problem)) {
        try {
            read_earlier(folder);
        } catch (const Error&) {
            throw Error(ErrorKind::usage, {},
                        "--output: " + in_quotes(folder) + " holds something else than a run of lancer bench");
        }
    }
    fs::create_directories(folder, problem);
    if (problem) throw Error(ErrorKind::failed, {folder}, "cannot make this folder: " + problem.message());
}

void write_files(const std::string& folder, const BenchRun& run, const BenchAgainst* against)
{
    const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
    write_text(path(json_name), to_json(run));
    write_text(path("bench.csv"), to_csv(run));
    write_text(path("bench.html"), to_html(make_page(run, against)));
}

void print(const BenchRun& run)
{
    const MachineBlock& m = run.machine;
    const auto load = [](const std::optional<double>& x) { return x ? format_text("%.2f", *x) : std::string("?"); };
    print_result(format_text("%s: %llu triangles; %s, Embree %s (%s)", run.file.c_str(),
                             static_cast<unsigned long long>(run.triangles), m.cpu.c_str(), m.embree.c_str(),
                             m.embree_isa.c_str()));
    print_result(format_text("%.1f s; load %s at the start, %s at the end; x: speed over that of %s", run.seconds,
                             load(m.load).c_str(), load(m.load_at_end).c_str(), run.baseline.c_str()));
    print_result(to_text(figures_table(run, false)));
}

void print(const BenchAgainst& against)
{
    for (const std::string& remark : against.remarks) print_problem("warning: --against: " + remark);
    print_result(verdict_of(against));
    if (against.differing() > 0) print_result(to_text(against_table(against, false)));
}

}  // namespace

int run_bench(int argc, char** argv)
{
    const double begin = wall_ns();
    const auto options = parse_bench(argc, argv);
    if (!options) return exit_done;
    Signals signals;
    const unsigned threads = options->picture.threads.value_or(available_threads());
    BenchRun run;
    MachineBlock machine = measure_machine("lancer bench", threads, "");
    if (!options->folder.empty()) take_folder(options->folder);
    std::optional<BenchRun> earlier;
    if (!options->against.empty()) earlier = read_earlier(options->against);
    with_threads(threads, [&] {
        const BenchScene scene(options->picture);
        run = describe_bench(scene, *options);
        machine.embree_isa = scene.isa();
        run.machine = machine;
        if (earlier) compare(run, *earlier, options->against);  // it would be refused in the end
        const BenchWork work{*options, begin + 1e9 * (options->seconds - seconds_for_report(options->seconds)),
                             [&] { return signals.poll(), signals.interrupted(); },
                             [&](const std::string& line) {
                                 if (!options->quiet) print_note(line);
                             }};
        measure_bench(scene, work, run);
    });
    run.interrupted = signals.interrupted();
    if (run.figures.empty()) return exit_interrupted;
    run.machine.load_at_end = load_average();
    run.seconds = 1e-9 * (wall_ns() - begin);
    std::optional<BenchAgainst> against;
    if (earlier) {
        against = compare(run, *earlier, options->against);
        annotate(run, *against);
    }
    if (options->json)
        print_result(to_json(run));
    else
        print(run);
    if (against && !options->json) print(*against);
    if (!options->folder.empty()) write_files(options->folder, run, against ? &*against : nullptr);
    return run.interrupted ? exit_interrupted : exit_done;
}

}  // namespace lancer
