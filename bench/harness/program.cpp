#include "harness/program.h"

#include <algorithm>

#include "app/console.h"
#include "app/exit_code.h"
#include "app/options/option_parser.h"
#include "app/options/option_values.h"
#include "core/error.h"
#include "core/lanes/denormals.h"
#include "core/parallel.h"
#include "harness/machine.h"

namespace lancer::bench {
namespace {

bool parse(int argc, char** argv, const std::string& name, const std::string& description, Options& o)
{
    const std::string footer =
        "Meshes that the project does not hold are taken from $LANCER_SHARED, else from ../shared, where there is one.";
    OptionParser p(name, description, footer);
    bool quick = false;
    p.flag("--quick", "What a minute or two allows (default)", quick);
    p.flag("--full", "Everything: more meshes, more rays, larger scenes", o.full);
    p.value("-t,--threads", "N", "Threads of what is measured (1)",
            [&](const std::string& text) { o.threads = to_count("--threads", text, 1, 1024); });
    p.value("--repetitions", "N", "Rounds that count, each of all contestants in turns, >= 5 (5)",
            [&](const std::string& text) { o.repetitions = to_count("--repetitions", text, 5, 1000); });
    p.values("--only", "NAME", "Only this mesh or scene; may be given several times",
             [&](const std::string& text) { o.only.push_back(text); });
    p.values("--accel", "NAME", "Only this accelerator; may be given several times",
             [&](const std::string& text) { o.accels.emplace_back(name_of(to_enum<AccelKind>("--accel", text))); });
    p.values("--mesh", "FILE", "A mesh (.obj) to measure besides; may be given several times",
             [&](const std::string& text) { o.meshes.push_back(text); });
    p.value("--cache", "FOLDER", "Where meshes are unpacked (build/bench-cache)",
            [&](const std::string& text) { o.cache = text; });
    p.value("-o,--output", "FILE.json", "Write the rows here, and as CSV beside it",
            [&](const std::string& text) { o.output = text; });
    if (!p.parse(argc, argv)) return false;
    if (quick && o.full) fail_usage("--quick and --full exclude each other");
    return true;
}

bool has(const std::vector<std::string>& names, const std::string& name)
{
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

bool Options::wants(const std::string& name) const { return has(only, name); }
bool Options::wants_accel(const std::string& name) const { return has(accels, name); }

void print_row(const Json& row)
{
    const auto number = [&](const char* key) { return row.value(key, 0.0); };
    std::string line = format_text("%-58s", row["name"].get<std::string>().c_str());
    if (row.contains("items_per_second"))
        line += format_text(" %12.4g /s  [%.4g .. %.4g]", number("items_per_second"), 1e9 / number("max"),
                            1e9 / number("min"));
    if (row.contains("ratio"))
        line += format_text("  x%.4f [%.4f .. %.4f]", number("ratio"), number("ratio_low"), number("ratio_high"));
    if (row.contains("instructions_ratio")) line += format_text("  instructions x%.5f", number("instructions_ratio"));
    for (const char* key :
         {"seconds", "bytes_per_triangle", "exponent", "share", "share_low", "share_high", "error_ratio", "gain",
          "gain_low", "gain_high", "extra_ns", "disagreements", "differing_pixels"})
        if (row.contains(key)) line += format_text("  %s %.4g", key, number(key));
    print_result(line);
    flush_results();  // whoever waits sees where it is
}

int run_program(int argc, char** argv, const std::string& name, const std::string& description,
                const std::function<void(const Options&, Report&)>& body)
{
    set_flush_denormals();
    return guarded([&] {
        Options options;
        if (!parse(argc, argv, name, description, options)) return exit_done;
        Report report(machine_context(argv[0], options.threads));
        with_threads(std::max(options.threads, available_threads()), [&] { body(options, report); });
        if (report.empty()) throw Error(ErrorKind::usage, {}, "--only: nothing of that name to measure");
        if (!options.output.empty()) report.write(options.output);
        if (!report.failure().empty()) throw Error(ErrorKind::failed, {}, report.failure());
        return exit_done;
    });
}

}  // namespace lancer::bench
