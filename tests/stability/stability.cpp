// stability: runs the rows of the stability matrix and writes a table, a page and JSON. scripts/stability.sh calls it.
#include <algorithm>
#include <filesystem>
#include <set>

#include "app/console.h"
#include "app/exit_code.h"
#include "app/options/option_parser.h"
#include "bench/report/markdown.h"
#include "core/error.h"
#include "core/lanes/denormals.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "report/page/html.h"
#include "stability/results.h"
#include "stability/sample_log.h"

namespace lancer::stability {
namespace {

// The product's choice first; what all are shown with where rays matter.
const std::vector<std::string> shown{"embree", "embree-fast", "bvh2", "bvh8"};

struct Options {
    Tier tier = Tier::A;
    std::string tier_name = "A";
    std::set<std::string> only;
    std::vector<std::string> accelerators;
    std::string folder;
};

bool parse(int argc, char** argv, Options& o)
{
    OptionParser p("stability", "Runs the rows of the stability matrix.",
                   "Exit codes: 0 all passed; 1 some failed; 2 wrong usage.");
    p.value("--tier", "A|B|C", "How much is run: A seconds, B minutes, C hours (A)", [&](const std::string& s) {
        if (s != "A" && s != "B" && s != "C") throw Error(ErrorKind::usage, {}, "--tier: '" + s + "' is not A, B or C");
        o.tier_name = s, o.tier = s == "A" ? Tier::A : s == "B" ? Tier::B : Tier::C;
    });
    p.values("--only", "ID", "Only this row, \"P4\", or this group, \"P\"; may be given again",
             [&](const std::string& s) { o.only.insert(s); });
    p.values(
        "--accel", "NAME", "Only this accelerator where rays matter; may be given again", [&](const std::string& s) {
            if (std::find(shown.begin(), shown.end(), s) == shown.end())
                throw Error(ErrorKind::usage, {}, "--accel: '" + s + "' is not one of embree, embree-fast, bvh2, bvh8");
            o.accelerators.push_back(s);
        });
    p.value("-o,--output", "FOLDER", "Write stability.html, .md and .json there; of a full run also a line of log.csv",
            [&](const std::string& s) { o.folder = s; });
    return p.parse(argc, argv);
}

std::string names_of(const std::vector<Row>& rows)
{
    std::string names;
    for (const Row& row : rows) names += (names.empty() ? "" : ", ") + row.id;
    return names;
}

std::vector<Row> chosen_rows(const Options& o)
{
    std::vector<Row> rows = all_rows();
    for (const std::string& id : o.only)
        if (std::none_of(rows.begin(), rows.end(), [&](const Row& r) { return r.id == id || r.id.substr(0, 1) == id; }))
            throw Error(ErrorKind::usage, {}, "--only: there is no row '" + id + "'; known: " + names_of(rows));
    std::erase_if(rows, [&](const Row& r) {
        return r.tier > o.tier || (!o.only.empty() && !o.only.contains(r.id) && !o.only.contains(r.id.substr(0, 1)));
    });
    if (rows.empty()) throw Error(ErrorKind::usage, {}, "nothing to run: these rows need a higher --tier");
    return rows;
}

void print(const Result& r)
{
    print_result(format_text("%-4s %-11s %-4s %7.2f s  %s", r.id.c_str(), r.accelerator.c_str(),
                             !r.judged    ? "told"
                             : r.passes() ? "pass"
                                          : "FAIL",
                             r.seconds, r.stiff.c_str()));
    if (!r.problem.empty()) print_result("       " + r.problem);
    for (const Measure& m : r.outcome.measures)
        if (!m.passes())
            print_result(format_text("       %s: %.6g, may be %s %.6g", m.what.c_str(), m.value,
                                     m.bound == Bound::at_most    ? "at most"
                                     : m.bound == Bound::at_least ? "at least"
                                                                  : "only",
                                     m.threshold));
    if (r.outcome.dropped > 0) print_result(format_text("       %zu samples dropped", size_t(r.outcome.dropped)));
}

int run(const Options& o)
{
    std::vector<Result> results;
    for (const Row& row : chosen_rows(o)) {
        const std::vector<std::string> with = !row.rays                ? std::vector<std::string>{"embree"}
                                              : o.accelerators.empty() ? shown
                                                                       : o.accelerators;
        for (const std::string& accelerator : with) {
            results.push_back(run_row(row, {o.tier, accelerator}, available_threads()));
            print(results.back());
            flush_results();  // a row may take minutes
        }
    }
    if (!o.folder.empty()) {
        std::filesystem::create_directories(o.folder);
        const bool is_full = o.only.empty() && o.accelerators.empty();
        std::optional<SampleCount> all_runs;
        if (is_full) all_runs = append_to_log(o.folder + "/log.csv", results, o.tier_name);
        const Document page = make_page(results, is_full ? all_sweeps() : std::vector<Sweep>{}, o.tier_name, all_runs);
        write_text(o.folder + "/stability.html", to_html(page));
        write_text(o.folder + "/stability.md", to_markdown(page, 2));
        write_text(o.folder + "/stability.json", to_json(results, o.tier_name));
    }
    const auto judged = std::count_if(results.begin(), results.end(), [](const Result& r) { return r.judged; });
    const auto passed =
        std::count_if(results.begin(), results.end(), [](const Result& r) { return r.judged && r.passes(); });
    print_result(format_text("%td passed, %td failed", passed, judged - passed));
    return passed == judged ? exit_done : exit_failed;
}

}  // namespace
}  // namespace lancer::stability

int main(int argc, char** argv)
{
    using namespace lancer;
    set_flush_denormals();
    return guarded([&] {
        stability::Options options;
        return stability::parse(argc, argv, options) ? stability::run(options) : exit_done;
    });
}
