// lancer study: methods on scenes with many seeds, each a run of its own, and what they came to as a page.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/study/lancer_runs.h"
#include "app/study/peers.h"
#include "app/study/pictures.h"
#include "app/system_info.h"
#include "app/version.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "report/page/html.h"
#include "report/page/text_table.h"
#include "report/study/check.h"
#include "report/study/csv.h"
#include "report/study/json.h"
#include "report/study/page.h"
#include "report/study/tables.h"

namespace lancer {
namespace {

class StudyRunner {
public:
    StudyRunner(const StudyOptions& options, const StudyPlan& plan) : work_{options, plan, signals_} {}
    int execute();

private:
    void begin();
    // All below return early after an interrupt.
    void prepare();
    void measure();
    void take(const RunResult& result);
    bool is_left_out(const std::string& scene, const std::string& method) const;
    void write();
    int write_report() const;
    StudyMethod& method_figures(const std::string& method);

    Signals signals_;
    StudyWork work_;
    Study study_;
    std::map<std::string, std::unique_ptr<PeerMethod>> peers_;  // by the name of the method
    std::map<std::string, Reference> references_;               // by that of the scene
    LastPictures pictures_;
};

StudyMethod& StudyRunner::method_figures(const std::string& method)
{
    return *std::find_if(study_.methods.begin(), study_.methods.end(), [&](const auto& m) { return m.name == method; });
}

bool StudyRunner::is_left_out(const std::string& scene, const std::string& method) const
{
    return !study_.on_scene(scene, method).left_out.empty();
}

void StudyRunner::begin()
{
    const StudyPlan& plan = work_.plan;
    study_.title = plan.title, study_.baseline = plan.baseline;
    study_.machine = {{"processor", cpu_model()},
                      {"threads", std::to_string(work_.options.threads.value_or(available_threads()))},
                      {"lancer", version_text()}};
    if (const auto load = load_average()) study_.machine.emplace_back("load before", format_text("%.2f", *load));
    if (std::string_view(LANCER_BUILD_TYPE) != "Release")
        study_.not_comparable.push_back("lancer was built as " LANCER_BUILD_TYPE ", not as Release");
    for (const StudyPlan::Method& m : plan.methods) {
        const bool peer = !m.peer.empty();
        study_.methods.push_back({m.name, m.description, {}, peer, LANCER_VERSION});
        if (!peer) continue;
        const auto& asked = *(peers_[m.name] = std::make_unique<PeerMethod>(work_, m));
        study_.methods.back().version = asked.version();
        if (!asked.version().empty()) study_.machine.emplace_back(m.name, m.peer + " " + asked.version());
        if (asked.has_own_reference())
            study_.methods.push_back({own_name(m.name),
                                      "The same pictures against a reference that it drew for itself: its noise alone",
                                      {},
                                      true,
                                      asked.version()});
    }
    for (const char* folder : {"references", "runs", "crops"}) std::filesystem::create_directories(work_.file(folder));
}

void StudyRunner::prepare()
{
    for (const StudyPlan::Scene& scene : work_.plan.scenes) {
        StudyScene& said = study_.scenes.emplace_back();
        std::optional<Reference> reference = draw_reference(work_, scene, said);
        if (!reference) return;
        references_.emplace(scene.name, std::move(*reference));
        for (const auto& [method, peer] : peers_) {
            print_note(scene.name + ": how fast is " + method);
            MethodOnScene known, own;
            known.scene = own.scene = scene.name, known.method = method, own.method = own_name(method);
            peer->prepare(scene, references_.at(scene.name), known, own);
            if (signals_.interrupted()) return;
            study_.on_scenes.push_back(known);
            if (peer->has_own_reference()) study_.on_scenes.push_back(own);
        }
    }
}

void StudyRunner::take(const RunResult& result)
{
    const StudyRun& run = result.runs.front();
    std::vector<std::string>& biases = method_figures(run.method).biases;
    for (const std::string& bias : result.biases)
        if (std::find(biases.begin(), biases.end(), bias) == biases.end()) biases.push_back(bias);
    if (result.picture) pictures_[{run.scene, run.method}].push_back(*result.picture);
    study_.runs.insert(study_.runs.end(), result.runs.begin(), result.runs.end());
}

void StudyRunner::measure()
{
    const StudyPlan& plan = work_.plan;
    // A speed alone is known after few.
    const auto seeds_of = [&](const StudyPlan::Method& m) {
        return m.throughput_only ? std::min(plan.seeds, 3u) : plan.seeds;
    };
    size_t all = 0, done = 0;
    for (const StudyPlan::Scene& scene : plan.scenes)
        for (const StudyPlan::Method& method : plan.methods)
            all += is_left_out(scene.name, method.name) ? 0 : seeds_of(method);
    const double start = wall_seconds();
    work_.started = 0;
    // Methods in turns, so that what slows the machine down for a while slows all of them down.
    for (uint64_t seed = 1; seed <= plan.seeds; ++seed)
        for (const StudyPlan::Scene& scene : plan.scenes)
            for (const StudyPlan::Method& method : plan.methods) {
                if (is_left_out(scene.name, method.name) || seed > seeds_of(method)) continue;
                const double left = work_.started == 0 ? 0
                                                       : (wall_seconds() - start) / static_cast<double>(work_.started) *
                                                             static_cast<double>(all - done);
                print_note(format_text("%zu of %zu: %s, %s, seed %d", ++done, all, scene.name.c_str(),
                                       method.name.c_str(), static_cast<int>(seed)) +
                           (left > 0 ? format_text("; about %.0f s left", left) : std::string()));
                const Reference& reference = references_.at(scene.name);
                const auto peer = peers_.find(method.name);
                const std::optional<RunResult> result = peer == peers_.end()
                                                            ? run_lancer(work_, scene, method, seed, reference)
                                                            : peer->second->run(scene, seed, reference);
                if (!result) return;
                take(*result);
            }
}

void StudyRunner::write()
{
    std::vector<ScenePictures> pictures;
    for (const StudyPlan::Scene& scene : work_.plan.scenes) {
        add_levels(study_, scene.name, pictures_, references_.at(scene.name));
        pictures.push_back(pictures_of(work_, study_, scene.name, pictures_, references_.at(scene.name)));
    }
    check_study(work_.options.study, study_);
    write_text(work_.file("study.json"), to_json(study_));
    write_text(work_.file("runs.csv"), to_csv(study_.runs));
    write_text(work_.file("index.html"), to_html(make_study_page(study_, pictures)));
}

// What was left out and what failed.
int StudyRunner::write_report() const
{
    size_t left_out = 0;
    std::string lines;
    for (const auto& [method, peer] : peers_)
        for (const StudyPlan::Scene& scene : work_.plan.scenes)
            if (is_left_out(scene.name, method)) {
                ++left_out;
                lines += "\n" + method + " on " + scene.name + ": " + study_.on_scene(scene.name, method).left_out;
            }
    if (left_out)
        print_problem(format_text("warning: %zu %s left out:", left_out,
                                  left_out == 1 ? "method" : "pairs of method and scene were") +
                      lines);
    const auto is_failed = [](const StudyRun& r) { return r.failed; };
    const auto failed = std::count_if(study_.runs.begin(), study_.runs.end(), is_failed);
    if (failed == 0) return exit_done;
    const auto first = std::find_if(study_.runs.begin(), study_.runs.end(), is_failed);
    print_problem(format_text("error: %zu of %zu runs failed; the first one, %s on %s, said:\n", size_t(failed),
                              study_.runs.size(), first->method.c_str(), first->scene.c_str()) +
                  first->problem);
    return exit_failed;
}

int StudyRunner::execute()
{
    begin();
    if (!signals_.interrupted()) prepare();
    if (!signals_.interrupted()) measure();
    if (signals_.interrupted()) {
        print_problem("warning: interrupted; the same command goes on where this one ended");
        return exit_interrupted;
    }
    write();
    if (study_.methods.size() > 1) print_result(to_text(overview_rows(study_)));
    for (const char* name : {"index.html", "study.json", "runs.csv"}) print_result(work_.file(name));
    return write_report();
}

// A study file may come from anyone.
void require_harmless(const StudyOptions& options, const StudyPlan& plan)
{
    const auto check = [&](const std::string& name, const std::vector<std::string>& words) {
        try {
            check_study_options(words);
        } catch (const Error& problem) {
            throw Error(ErrorKind::invalid_input, {options.study},
                        in_quotes(name) + ": options: " + message_of(problem));
        }
    };
    for (const StudyPlan::Scene& s : plan.scenes) check(s.name, s.options);
    for (const StudyPlan::Method& m : plan.methods) {
        check(m.name, m.options);
        if (!m.peer.empty() && !options.allow_peers)
            throw Error(ErrorKind::usage, {},
                        in_quotes(m.name) + " runs another program, " + in_quotes(plan.peers + "/run") +
                            ": if you trust it, add --allow-peers");
    }
}

}  // namespace

int run_study(int argc, char** argv)
{
    const auto options = parse_study(argc, argv);
    if (!options) return exit_done;
    Diagnostics diagnostics;
    const StudyPlan plan = load_study_file(options->study, diagnostics);
    diagnostics.throw_if_errors();
    for (const auto& warning : diagnostics.warnings()) print_problem(to_string(warning));
    require_harmless(*options, plan);
    return StudyRunner(*options, plan).execute();
}

}  // namespace lancer
