#include "app/study/lancer_runs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "app/console.h"
#include "app/exit_code.h"
#include "app/load_scene.h"
#include "app/study/child.h"
#include "app/version.h"
#include "io/image/exr.h"
#include "io/input_text.h"
#include "report/metrics/metrics.h"
#include "report/stats_json.h"
#include "report/study/error_rows.h"

namespace lancer {
namespace {

// References have seeds that no one gives to a run.
constexpr uint64_t first_reference_seed = uint64_t{1} << 48;

// Of a picture's ledger what is not the end of the run: every picture that counts is whole.
std::vector<std::string> ledger_of(const Metadata& metadata)
{
    std::vector<std::string> ledger;
    std::istringstream entries(text_of(metadata, "bias"));
    for (std::string entry; std::getline(entries >> std::ws, entry, ',');)
        if (entry != "none" && entry != "stopped_by_time") ledger.push_back(entry);
    return ledger;
}

bool holds(const std::vector<std::string>& list, const std::string& entry)
{
    return std::find(list.begin(), list.end(), entry) != list.end();
}

// What sets a method apart from the reference, one way or the other.
std::vector<std::string> biases_against(const std::vector<std::string>& reference,
                                        const std::vector<std::string>& method)
{
    std::vector<std::string> biases;
    for (const std::string& entry : method)
        if (!holds(reference, entry)) biases.push_back(entry);
    for (const std::string& entry : reference)
        if (!holds(method, entry)) biases.push_back("without " + entry);
    return biases;
}

std::vector<std::string> render_arguments(const StudyWork& work, const StudyPlan::Scene& scene,
                                          const std::vector<std::string>& options,
                                          const std::vector<std::pair<const char*, std::string>>& more)
{
    std::vector<std::string> arguments{"render", scene.file, "-q"};
    arguments.insert(arguments.end(), scene.options.begin(), scene.options.end());
    arguments.insert(arguments.end(), options.begin(), options.end());
    for (const auto& [option, value] : more) arguments.insert(arguments.end(), {option, value});
    if (work.options.threads) arguments.insert(arguments.end(), {"-t", std::to_string(*work.options.threads)});
    return arguments;
}

// Renders unless the same has been rendered before. What went wrong, empty if nothing did; after an interrupt either.
std::string render(StudyWork& work, const std::vector<std::string>& arguments, const std::string& picture)
{
    std::string key = "lancer " LANCER_VERSION;
    for (const std::string& word : arguments) key += " " + in_shell_quotes(word);
    if (is_done(picture, key)) return {};
    unmark(picture);
    ++work.started;
    const ChildResult result = run_self(arguments, work.signals);
    if (work.signals.interrupted()) return {};
    if (result.code == exit_done) mark_done(picture, key);
    return result.code == exit_done ? ""
           : result.err.empty()     ? "ended with " + std::to_string(result.code)
                                    : result.err;
}

}  // namespace

std::optional<Reference> draw_reference(StudyWork& work, const StudyPlan::Scene& scene, StudyScene& figures)
{
    Diagnostics diagnostics;
    SceneChoice choice;
    choice.file = scene.file;
    Reference reference;
    reference.hash = to_hex(load_scene(choice, diagnostics).content_hash);
    for (uint64_t i = 0; i < 2; ++i) {
        reference.files[i] =
            work.file("references/" + scene.name + "-" + reference.hash + "." + std::to_string(i + 1) + ".exr");
        print_note(format_text("%s: reference, half %d of 2, %u spp", scene.name.c_str(), static_cast<int>(i) + 1,
                               scene.reference_spp));
        const std::string problem = render(work,
                                           render_arguments(work, scene, {},
                                                            {{"-o", reference.files[i]},
                                                             {"-s", std::to_string(scene.reference_spp)},
                                                             {"--seed", std::to_string(first_reference_seed + i)}}),
                                           reference.files[i]);
        if (work.signals.interrupted()) return {};
        if (!problem.empty())
            throw Error(ErrorKind::failed, {scene.file}, "its reference could not be drawn:\n" + problem);
        Metadata metadata;
        reference.halves[i] = read_exr(reference.files[i], &metadata);
        reference.limits = ledger_of(metadata);
        reference.box_filter = text_of(metadata, "filter") == "box";
    }
    figures.name = scene.name, figures.description = scene.description;
    figures.reference = format_text("lancer %s, two halves of %u spp each, seeds of their own, scene %s",
                                    LANCER_VERSION, scene.reference_spp, reference.hash.c_str());
    for (size_t i = 0; i < reference.limits.size(); ++i)
        figures.reference += (i ? ", " : "; its limits, shared by the methods: ") + reference.limits[i];
    // Half of how far they lie apart is the noise of one of them; their mean has half of that.
    figures.reference_noise_relmse = compare(reference.halves[0], reference.halves[1]).relmse / 4;
    return reference;
}

std::optional<RunResult> run_lancer(StudyWork& work, const StudyPlan::Scene& scene, const StudyPlan::Method& method,
                                    uint64_t seed, const Reference& reference)
{
    const std::string name = work.file("runs/" + scene.name + "." + method.name + "." + std::to_string(seed));
    std::vector<std::pair<const char*, std::string>> more{{"--seed", std::to_string(seed)}};
    if (method.time) more.emplace_back("--time", shortest(*method.time));
    if (work.plan.spp) more.emplace_back("-s", std::to_string(*work.plan.spp));
    more.insert(more.end(), {{"--reference", reference.files[0]},
                             {"--reference2", reference.files[1]},
                             {"--error-log", name + ".csv"},
                             {"-o", name + ".exr"}});
    RunResult result;
    StudyRun& run = result.runs.emplace_back();
    run.scene = scene.name, run.method = method.name, run.seed = seed;
    run.problem = render(work, render_arguments(work, scene, method.options, more), name + ".exr");
    if (work.signals.interrupted()) return {};
    run.failed = !run.problem.empty();
    if (run.failed) return result;
    const std::vector<ErrorRow> rows = read_error_rows(name + ".csv", read_input_text(name + ".csv"));
    for (const ErrorRow& row : rows) {
        // Of the doublings only: there all pixels have all samples.
        const bool has_doubled = row.spp == std::floor(row.spp) && std::exp2(std::floor(std::log2(row.spp))) == row.spp;
        if (!has_doubled) continue;
        // Where denoising an earlier picture took so long that this one is there no later, nobody wants that one.
        while (!run.points.empty() && run.points.back().wall_s >= row.wall_s) run.points.pop_back();
        run.points.push_back(point_of(row));
    }
    result.biases = biases_against(reference.limits, ledger_of(read_exr_info(name + ".exr").metadata));
    if (!rows.empty()) result.picture = {name + ".exr", rows.back().spp, rows.back().wall_s};
    return result;
}

}  // namespace lancer
