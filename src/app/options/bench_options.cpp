// The command line of lancer bench.
#include <algorithm>

#include "app/bench/methods.h"
#include "app/options/option_values.h"
#include "app/options/shared_options.h"

namespace lancer {
namespace {

// "a,b", of these; several options add to each other.
void add_chosen(const std::string& option, const std::string& text, std::span<const std::string_view> known,
                std::vector<std::string>& chosen)
{
    for (const std::string& name : split(text, ',')) {
        to_choice(option, name, known);
        if (std::find(chosen.begin(), chosen.end(), name) == chosen.end()) chosen.push_back(name);
    }
}

// In the order of the list.
void put_in_order(std::span<const std::string_view> known, std::vector<std::string>& names)
{
    std::vector<std::string> ordered;
    for (const std::string_view name : known)
        if (std::find(names.begin(), names.end(), name) != names.end()) ordered.emplace_back(name);
    names = std::move(ordered);
}

}  // namespace

std::optional<BenchOptions> parse_bench(int argc, char** argv)
{
    BenchOptions o;
    bool quick = false, timed = false;
    const std::vector<std::string_view> methods = bench_method_names();
    OptionParser p(
        "lancer bench",
        "Measure accelerators beside Embree on a mesh, with the rays of a render of it: building, memory, "
        "speed for each kind of ray, wrong and missed hits, and time for a whole picture. Methods take turns "
        "in short rounds; ratios are to Embree robust within a round, with 95 % intervals.",
        exit_codes_help + std::string(interrupted_help) +
            "An interrupt ends the measurement; what it has is printed and written.\n\n"
            "Example:\n  lancer bench bunny.obj -o bunny\n");
    add_scene_options(p, o.picture.scene);
    p.group("What is measured");
    p.value("--time", "T", "How long all of it takes: 120s, 5m (120s)", [&](const std::string& t) {
        o.seconds = to_seconds("--time", t);
        timed = true;
    });
    p.flag("--quick", "The same as --time 20s", quick);
    p.values("--accel", "NAME,...",
             "Methods besides embree-robust: " + listed(methods) + " (embree-fast,bvh8,bvh2,median)",
             [&](const std::string& t) { add_chosen("--accel", t, methods, o.methods); });
    p.values("--rays", "KIND,...", "Kinds of rays: " + listed(ray_set_kinds) + " (all)",
             [&](const std::string& t) { add_chosen("--rays", t, ray_set_kinds, o.rays); });
    p.value("--error", "X", "Error of the picture, the root of a relative mean square (0.02)",
            [&](const std::string& t) { o.error = to_number<double>("--error", t, 1e-4, 10, "a number"); });
    p.group("What becomes of it");
    p.value("-o,--output", "FOLDER", "Write bench.html, bench.json (in the shape of Google Benchmark's) and bench.csv",
            [&](const std::string& t) { o.folder = t; });
    p.value("--against", "EARLIER", "A folder or bench.json of the same mesh: which ratios differ",
            [&](const std::string& t) { o.against = t; });
    p.flag("--json", "Print bench.json, and nothing else, on the standard output", o.json);
    p.flag("-q,--quiet", "Only warnings, errors and results", o.quiet);
    p.group("How it runs");
    add_threads(p, o.picture.threads);
    add_memory(p, o.picture.memory);
    if (!p.parse(argc, argv)) return {};
    if (quick && timed) fail_usage("--quick and --time exclude each other");
    if (quick) o.seconds = 20;
    if (o.methods.empty()) o.methods.assign(usual_bench_methods.begin(), usual_bench_methods.end());
    o.methods.emplace_back(bench_baseline);
    put_in_order(methods, o.methods);
    if (o.rays.empty()) o.rays.assign(ray_set_kinds.begin(), ray_set_kinds.end());
    put_in_order(ray_set_kinds, o.rays);
    o.picture.scene.still = true;  // Embree knows no motion
    take_environment(o.picture.threads);
    return o;
}

}  // namespace lancer
