// lancer study: methods on scenes with many seeds, each a render of its own, and what they came to as a page.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "app/child.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/load_scene.h"
#include "app/options.h"
#include "app/system_info.h"
#include "app/version.h"
#include "core/hash.h"
#include "io/atomic_file.h"
#include "io/exr.h"
#include "io/input_text.h"
#include "io/study_file.h"
#include "report/html.h"
#include "report/metrics.h"
#include "report/stats_json.h"
#include "report/study_check.h"
#include "report/study_csv.h"
#include "report/study_json.h"
#include "report/study_page.h"

namespace lancer {
namespace {

namespace fs = std::filesystem;

// References have seeds that no one gives to a run.
constexpr uint64_t first_reference_seed = uint64_t{1} << 48;

std::string text_of(const std::string& path) { return fs::exists(path) ? read_input_text(path) : std::string(); }

// What an error log of a render says, of the doublings only: there all pixels have all samples.
std::vector<ErrorPoint> points_of(const std::string& csv)
{
    std::vector<ErrorPoint> points;
    std::istringstream lines(csv);
    std::string line, field;
    std::vector<std::string> names;
    while (std::getline(lines, line)) {
        std::map<std::string, double> row;
        std::istringstream fields(line + ",");
        for (size_t i = 0; std::getline(fields, field, ','); ++i) {
            if (points.empty() && i >= names.size() && field.find_first_of("0123456789") == std::string::npos) {
                names.push_back(field);
                continue;
            }
            double value = std::nan("");
            std::from_chars(field.data(), field.data() + field.size(), value);
            row[names.at(i)] = value;
        }
        if (row.empty()) continue;
        const double spp = row["spp"];
        if (spp != std::floor(spp) || std::exp2(std::floor(std::log2(spp))) != spp) continue;
        const auto count = [&](const char* name) { return static_cast<uint64_t>(row[name]); };
        const double unbiased = row["relmse_unbiased"];
        points.push_back({.spp = static_cast<uint32_t>(spp),
                          .wall_s = row["wall_s"],
                          .cpu_s = row["cpu_s"],
                          .rays_camera = count("camera_rays"),
                          .rays_bounce = count("bounce_rays"),
                          .rays_shadow = count("shadow_rays"),
                          .rmse = row["rmse"],
                          .relmse = std::isnan(unbiased) ? row["relmse"] : unbiased,
                          .relmse_trimmed = row["relmse_trimmed"],
                          .smape = row["smape"],
                          .flip = row["flip"]});
    }
    return points;
}

// Of a picture's ledger what is not the end of the run: every picture that counts is whole.
std::vector<std::string> biases_of_picture(const std::string& path)
{
    std::vector<std::string> biases;
    for (const auto& [name, value] : read_exr_info(path).metadata) {
        if (name != "bias") continue;
        std::istringstream entries(to_string(value));
        for (std::string entry; std::getline(entries >> std::ws, entry, ',');)
            if (entry != "none" && entry != "stopped_by_time") biases.push_back(entry);
    }
    return biases;
}

class StudyRunner {
public:
    StudyRunner(const StudyOptions& options, StudyPlan plan) : options_(options), plan_(std::move(plan)) {}
    int execute();

private:
    struct Halves {
        std::string first, second;
    };
    Halves draw_reference(const StudyPlan::Scene& scene);
    void measure(const StudyPlan::Scene& scene, const StudyPlan::Method& method, uint64_t seed, const Halves& halves);
    // Renders unless the same has been rendered before; false if it fails, which is then in `problem`.
    bool render(const std::vector<std::string>& arguments, const std::string& picture, std::string& problem);
    std::string file(const std::string& name) const { return fs::path(options_.folder) / name; }
    void write() const;

    const StudyOptions& options_;
    const StudyPlan plan_;
    Signals signals_;
    Study study_;
    size_t drawn_ = 0;
};

bool StudyRunner::render(const std::vector<std::string>& arguments, const std::string& picture, std::string& problem)
{
    std::string key = "lancer " LANCER_VERSION;
    for (const std::string& word : arguments) key += " " + in_shell_quotes(word);
    // Written last, so that where it is all is.
    const std::string done = picture + ".done";
    if (text_of(done) == key + "\n") return true;
    fs::remove(done);
    const ChildResult result = run_self(arguments, signals_);
    ++drawn_;
    if (signals_.interrupted()) return false;
    problem = result.err;
    if (result.code != exit_done) return false;
    write_text(done, key + "\n");
    return true;
}

StudyRunner::Halves StudyRunner::draw_reference(const StudyPlan::Scene& scene)
{
    Diagnostics diagnostics;
    SceneChoice choice;
    choice.file = scene.file;
    const uint64_t hash = load_scene(choice, diagnostics).content_hash;
    std::array<std::string, 2> halves;
    for (uint64_t i = 0; i < 2; ++i) {
        halves[i] = file("references/" + scene.name + "-" + to_hex(hash) + "." + std::to_string(i + 1) + ".exr");
        std::vector<std::string> arguments{"render", scene.file, "-q", "-o", halves[i]};
        arguments.insert(arguments.end(), scene.options.begin(), scene.options.end());
        for (const std::string& word : {std::string("-s"), std::to_string(scene.reference_spp), std::string("--seed"),
                                        std::to_string(first_reference_seed + i)})
            arguments.push_back(word);
        if (options_.threads) arguments.insert(arguments.end(), {"-t", std::to_string(*options_.threads)});
        print_note(format_text("%s: reference, half %d of 2, %u spp", scene.name.c_str(), static_cast<int>(i) + 1,
                               scene.reference_spp));
        std::string problem;
        if (!render(arguments, halves[i], problem) && !signals_.interrupted())
            throw Error(ErrorKind::failed, {scene.file}, "its reference could not be drawn:\n" + problem);
        if (signals_.interrupted()) return {};
    }
    StudyScene told;
    told.name = scene.name, told.description = scene.description;
    told.reference = format_text("lancer %s, two halves of %u spp each, seeds of their own, scene %s", LANCER_VERSION,
                                 scene.reference_spp, to_hex(hash).c_str());
    // Half of how far they lie apart is the noise of one of them; their mean has half of that.
    told.reference_noise_relmse = compare(read_exr(halves[0]), read_exr(halves[1])).relmse / 4;
    study_.scenes.push_back(told);
    return {halves[0], halves[1]};
}

void StudyRunner::measure(const StudyPlan::Scene& scene, const StudyPlan::Method& method, uint64_t seed,
                          const Halves& halves)
{
    const std::string name = file("runs/" + scene.name + "." + method.name + "." + std::to_string(seed));
    std::vector<std::string> arguments{"render", scene.file, "-q"};
    arguments.insert(arguments.end(), scene.options.begin(), scene.options.end());
    arguments.insert(arguments.end(), method.options.begin(), method.options.end());
    const auto add = [&](const char* option, const std::string& value) {
        arguments.emplace_back(option);
        arguments.push_back(value);
    };
    add("--seed", std::to_string(seed));
    if (plan_.time) add("--time", shortest(*plan_.time));
    if (plan_.spp) add("-s", std::to_string(*plan_.spp));
    if (options_.threads) add("-t", std::to_string(*options_.threads));
    add("--reference", halves.first), add("--reference2", halves.second);
    add("--error-log", name + ".csv"), add("-o", name + ".exr");
    StudyRun run;
    run.scene = scene.name, run.method = method.name, run.seed = seed;
    run.failed = !render(arguments, name + ".exr", run.problem);
    if (signals_.interrupted()) return;
    if (!run.failed) {
        run.points = points_of(text_of(name + ".csv"));
        StudyMethod& told = *std::find_if(study_.methods.begin(), study_.methods.end(),
                                          [&](const StudyMethod& m) { return m.name == method.name; });
        told.biases = biases_of_picture(name + ".exr");
    }
    study_.runs.push_back(std::move(run));
}

void StudyRunner::write() const
{
    check_study(options_.study, study_);
    write_text(file("study.json"), to_json(study_));
    write_text(file("runs.csv"), to_csv(study_.runs));
    write_text(file("index.html"), to_html(make_study_page(study_, {})));
}

int StudyRunner::execute()
{
    fs::create_directories(file("references"));
    fs::create_directories(file("runs"));
    study_.title = plan_.title, study_.baseline = plan_.baseline;
    for (const StudyPlan::Method& m : plan_.methods) {
        StudyMethod& told = study_.methods.emplace_back();
        told.name = m.name, told.description = m.description, told.version = LANCER_VERSION;
    }
    study_.machine = {
        {"processor", cpu_model()}, {"load before", format_text("%.2f", load_average())}, {"lancer", version_text()}};
    if (std::string_view(LANCER_BUILD_TYPE) != "Release")
        study_.not_comparable.push_back("lancer was built as " LANCER_BUILD_TYPE ", not as Release");
    std::vector<Halves> halves;
    for (const StudyPlan::Scene& scene : plan_.scenes)
        if (!signals_.interrupted()) halves.push_back(draw_reference(scene));
    const size_t all = plan_.scenes.size() * plan_.methods.size() * plan_.seeds;
    const double start = wall_seconds();
    drawn_ = 0;
    size_t done = 0;
    // Methods in turns, so that what slows the machine down for a while slows all of them down.
    for (uint64_t seed = 1; seed <= plan_.seeds; ++seed)
        for (size_t s = 0; s < plan_.scenes.size(); ++s)
            for (const StudyPlan::Method& method : plan_.methods) {
                if (signals_.interrupted()) break;
                const double left = drawn_ == 0 ? 0
                                                : (wall_seconds() - start) / static_cast<double>(drawn_) *
                                                      static_cast<double>(all - done);
                print_note(format_text("%zu of %zu: %s, %s, seed %d", ++done, all, plan_.scenes[s].name.c_str(),
                                       method.name.c_str(), static_cast<int>(seed)) +
                           (left > 0 ? format_text("; about %.0f s left", left) : std::string()));
                measure(plan_.scenes[s], method, seed, halves[s]);
            }
    if (signals_.interrupted()) {
        print_problem("warning: interrupted; the same command goes on where this one ended");
        return exit_interrupted;
    }
    write();
    for (const char* name : {"index.html", "study.json", "runs.csv"}) print_result(file(name));
    const auto failed = std::count_if(study_.runs.begin(), study_.runs.end(), [](const auto& r) { return r.failed; });
    if (failed == 0) return exit_done;
    const auto first = std::find_if(study_.runs.begin(), study_.runs.end(), [](const auto& r) { return r.failed; });
    print_problem(format_text("error: %zu of %zu runs failed; the first one, %s on %s, said:\n", size_t(failed), all,
                              first->method.c_str(), first->scene.c_str()) +
                  first->problem);
    return exit_failed;
}

}  // namespace

int run_study(int argc, char** argv)
{
    const auto options = parse_study(argc, argv);
    if (!options) return exit_done;
    Diagnostics diagnostics;
    StudyPlan plan = load_study_file(options->study, diagnostics);
    diagnostics.throw_if_errors();
    return StudyRunner(*options, std::move(plan)).execute();
}

}  // namespace lancer
