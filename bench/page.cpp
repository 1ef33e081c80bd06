// bench_page: one page of HTML, or Markdown, out of the files of a run of the bench programs.
#include <algorithm>
#include <filesystem>

#include "app/console.h"
#include "app/exit_code.h"
#include "app/options/option_parser.h"
#include "bench/report/markdown.h"
#include "bench/report/page.h"
#include "bench/report/repeat.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/input_text.h"
#include "report/page/html.h"

namespace lancer {
namespace {

struct PageOptions {
    std::string run, earlier, page, markdown;
};

bool parse(int argc, char** argv, PageOptions& o)
{
    OptionParser p("bench_page", "Makes a page of what the bench programs measured.", "");
    p.argument("RUN", "A folder of .json files, or one file", [&](const std::string& s) { o.run = s; });
    p.value("-o,--output", "PAGE.html", "Write the page here", [&](const std::string& s) { o.page = s; });
    p.value("--markdown", "FILE.md", "Write its words and tables here", [&](const std::string& s) { o.markdown = s; });
    p.value("--compare", "RUN", "An earlier run, folder or file: does this one confirm its ratios?",
            [&](const std::string& s) { o.earlier = s; });
    return p.parse(argc, argv);
}

BenchFile read_one(const std::string& path) { return read_bench(path, read_input_text(path)); }

// By name, so that the page does not depend on the order of a folder.
std::vector<BenchFile> read_run(const std::string& path)
{
    if (!std::filesystem::is_directory(path)) return {read_one(path)};
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path))
        if (entry.path().extension() == ".json") names.push_back(entry.path().string());
    std::sort(names.begin(), names.end());
    if (names.empty()) throw Error(ErrorKind::missing_input, {path, 0, 0}, "no .json file in this folder");
    std::vector<BenchFile> files;
    for (const std::string& name : names) files.push_back(read_one(name));
    return files;
}

// What a page would say first, for a terminal.
void print_verdicts(const std::vector<BenchFile>& files, const std::vector<BenchFile>& earlier)
{
    for (const std::string& reason : verdicts(files)) print_result("not comparable: " + reason);
    if (earlier.empty()) return;
    for (const std::string& reason : comparison_reasons(earlier, files))
        print_result("not comparable with the earlier run: " + reason);
    const std::vector<RepeatedRow> rows = repeated_rows(earlier, files);
    const auto agree = std::count_if(rows.begin(), rows.end(), [](const RepeatedRow& row) { return row.agrees(); });
    print_result(format_text("%td of %zu ratios confirmed", agree, rows.size()));
}

void run(const PageOptions& options)
{
    const std::vector<BenchFile> files = read_run(options.run);
    std::vector<BenchFile> earlier;
    if (!options.earlier.empty()) earlier = read_run(options.earlier);
    const Document page = make_bench_page(files, earlier);
    if (!options.page.empty()) write_text(options.page, to_html(page));
    if (!options.markdown.empty()) write_text(options.markdown, to_markdown(page, 3));
    print_verdicts(files, earlier);
}

}  // namespace
}  // namespace lancer

int main(int argc, char** argv)
{
    using namespace lancer;
    return guarded([&] {
        PageOptions options;
        if (parse(argc, argv, options)) run(options);
        return exit_done;
    });
}
