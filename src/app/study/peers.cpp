#include "app/study/peers.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "app/console.h"
#include "app/exit_code.h"
#include "app/study/child.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "io/image/exr.h"
#include "io/input_text.h"
#include "report/metrics/metrics.h"
#include "report/study/error_rows.h"

namespace lancer {
namespace {

namespace fs = std::filesystem;

// Exit codes of the script, besides those of this program.
constexpr int exit_not_installed = 69;
// Peers take seeds below 2^31: those of their references are far from those of runs.
constexpr uint64_t first_peer_reference_seed = uint64_t{1} << 30;
constexpr uint32_t first_probe = 4;

// The first line of an error message.
std::string first_error(const std::string& err)
{
    std::istringstream lines(err);
    std::string line, first;
    while (std::getline(lines, line)) {
        if (first.empty()) first = line;
        if (const size_t at = line.find("error: "); at != std::string::npos) return line.substr(at + 7);
    }
    return first.empty() ? "no output" : first;
}

std::string why_failed(const ChildResult& result, double timeout)
{
    if (result.timed_out) return format_text("did not end within %g s", timeout);
    return "ended with " + std::to_string(result.code) + ":\n" + (result.err.empty() ? "nothing said" : result.err);
}

// The options of the scene that a peer supports; `left_out` gets the first one that it does not.
std::string size_of(const std::vector<std::string>& options, std::string& left_out)
{
    std::string size;
    for (size_t i = 0; i < options.size(); ++i) {
        const bool has_value = i + 1 < options.size();
        if (options[i] == "--size" && has_value)
            size = options[++i];
        else if (options[i] == "--filter" && has_value)
            ++i;  // which one is seen from the reference
        else if (left_out.empty())
            left_out =
                "another program has no equivalent of " + in_quotes(options[i]) + " among the options of the scene";
    }
    return size;
}

// The errors of each picture, as rows. One that took longer than a later one of more samples is left out.
std::string rows_text(const std::vector<PeerRecord>& records, const std::vector<Image>& pictures,
                      const Reference& reference)
{
    std::vector<ErrorRow> rows;
    for (size_t i = 0; i < records.size(); ++i) {
        ErrorRow row;
        row.spp = records[i].spp;
        row.wall_s = records[i].render_wall_s, row.cpu_s = records[i].render_cpu_s;
        row.camera_rays = uint64_t{records[i].spp} * pictures[i].pixels.size();
        measure_errors(row, pictures[i], reference.halves[0], &reference.halves[1], true);
        while (!rows.empty() && rows.back().wall_s >= row.wall_s) rows.pop_back();
        rows.push_back(row);
    }
    std::string text = error_rows_head();
    for (const ErrorRow& row : rows) text += to_csv(row);
    return text;
}

std::vector<ErrorPoint> points_of(const std::string& path)
{
    std::vector<ErrorPoint> points;
    for (const ErrorRow& row : read_error_rows(path, read_input_text(path))) points.push_back(point_of(row));
    return points;
}

}  // namespace

std::string own_name(const std::string& method) { return method + " (own reference)"; }

PeerMethod::PeerMethod(StudyWork& work, const StudyPlan::Method& method)
    : work_(work), method_(method), script_(fs::absolute(fs::path(work.plan.peers) / "run"))
{
    if (access(script_.c_str(), X_OK) != 0) {
        missing_ = "there is no script " + in_quotes(script_);
        return;
    }
    const ChildResult said = run_child({.program = script_,
                                        .name = {},
                                        .arguments = {"--about", method.peer},
                                        .environment = {},
                                        .timeout_s = work.plan.peer_timeout},
                                       work.signals);
    if (work.signals.interrupted()) return;
    if (said.code == exit_usage)
        throw Error(ErrorKind::invalid_input, {work.options.study},
                    "[[method]] " + in_quotes(method.name) + ": " + first_error(said.err));
    if (said.code == exit_not_installed)
        missing_ = first_error(said.err);
    else if (said.code != exit_done || said.timed_out)
        problem_ = why_failed(said, work.plan.peer_timeout);
    else
        try {
            about_ = read_peer_about(method.peer, said.out);
        } catch (const Error& e) {
            problem_ = e.what();
        }
}

std::string PeerMethod::picture(const std::string& name, uint32_t spp) const
{
    return name + "." + std::to_string(spp) + ".exr";
}

std::string PeerMethod::key_of(const Reference& reference, const OnScene& on, const Order& order) const
{
    std::string key = method_.peer + " " + about_.version + " seed " + std::to_string(order.seed) + " size " + on.size +
                      " threads " + std::to_string(work_.options.threads.value_or(available_threads())) +
                      (method_.throughput_only ? " throughput only" : "");
    for (const std::string& file : reference.files) key += " " + file;
    for (const uint32_t n : order.samples) key += " " + std::to_string(n);
    return key;
}

PeerMethod::Outcome PeerMethod::start(const StudyPlan::Scene& scene, const OnScene& on, const Order& order)
{
    std::string samples;
    for (const uint32_t n : order.samples) samples += (samples.empty() ? "" : ",") + std::to_string(n);
    ChildOrder child{.program = script_,
                     .name = {},
                     .arguments = {method_.peer, scene.file, "-o", order.name + ".%d.exr", "--spps", samples,
                                   "--threads", std::to_string(work_.options.threads.value_or(available_threads()))},
                     .environment = {{"LANCER", own_program()}},
                     .timeout_s = work_.plan.peer_timeout};
    const auto add = [&](const std::vector<std::string>& words) {
        child.arguments.insert(child.arguments.end(), words.begin(), words.end());
    };
    if (about_.seeds) add({"--seed", std::to_string(order.seed)});
    if (!on.size.empty()) add({"--size", on.size});
    if (method_.throughput_only) add({"--throughput-only"});
    ++work_.started;
    const ChildResult said = run_child(child, work_.signals);
    Outcome outcome;
    if (work_.signals.interrupted()) return outcome;
    outcome.refused = !said.timed_out && (said.code == exit_invalid || said.code == exit_not_installed);
    if (outcome.refused) {
        outcome.problem = first_error(said.err);
    } else if (said.timed_out || said.code != exit_done) {
        outcome.problem = why_failed(said, work_.plan.peer_timeout);
    } else {
        try {
            outcome.records = read_peer_records(method_.peer, said.out, order.samples);
            write_text(order.name + ".jsonl", said.out);
        } catch (const Error& e) {
            outcome.problem = e.what();
        }
    }
    return outcome;
}

void PeerMethod::choose_samples(const StudyPlan::Scene& scene, const Reference& reference, OnScene& on,
                                MethodOnScene& known)
{
    const auto [time, most] = std::pair(method_.time, work_.plan.spp);
    Order probe{.name = work_.file("runs/" + scene.name + "." + method_.name + ".probe"), .samples = {}};
    const std::string key = key_of(reference, on, probe) + (time ? " time " + shortest(*time) : "") +
                            (most ? " spp " + std::to_string(*most) : "");
    const std::string kept = probe.name + ".samples";
    double seconds_per_sample = 0;
    if (is_done(kept, key)) {
        std::istringstream(read_input_text(kept)) >> seconds_per_sample;
    } else {
        const double wanted = time ? probe_part * *time : 0;
        for (uint32_t n = first_probe;;) {
            probe.samples = {n};
            const Outcome outcome = start(scene, on, probe);
            if (work_.signals.interrupted()) return;
            (outcome.refused ? known.left_out : on.problem) = outcome.problem;
            if (!outcome.problem.empty()) return;
            fs::remove(picture(probe.name, n));
            const double seconds = outcome.records[0].render_wall_s;
            seconds_per_sample = seconds / n;
            if (seconds >= wanted || n >= most.value_or(1u << 20)) break;
            // By powers of four, as they are squares.
            const double further = std::clamp(wanted / std::max(seconds, wanted / 256), 4.0, 256.0);
            n = static_cast<uint32_t>(n * std::pow(4, std::ceil(std::log2(further) / 2)));
        }
        write_text(kept, shortest(seconds_per_sample) + "\n");
        mark_done(kept, key);
    }
    on.samples = peer_samples(seconds_per_sample, time, most, about_.squares);
    if (method_.throughput_only) on.samples = {on.samples.back()};
}

void PeerMethod::draw_own_reference(const StudyPlan::Scene& scene, const Reference& reference, OnScene& on,
                                    MethodOnScene& own)
{
    Reference drawn;
    for (uint64_t i = 0; i < 2; ++i) {
        Order order{.name = work_.file("references/" + scene.name + "-" + reference.hash + "." + method_.name + "." +
                                       std::to_string(i + 1)),
                    .samples = {method_.own_reference_spp},
                    .seed = first_peer_reference_seed + i};
        drawn.files[i] = picture(order.name, method_.own_reference_spp);
        const std::string key = key_of(reference, on, order);
        if (!is_done(drawn.files[i], key)) {
            print_note(format_text("%s: reference of %s, half %d of 2, %u spp", scene.name.c_str(),
                                   method_.name.c_str(), static_cast<int>(i) + 1, method_.own_reference_spp));
            unmark(drawn.files[i]);
            on.problem = start(scene, on, order).problem;
            if (work_.signals.interrupted() || !on.problem.empty()) return;
            mark_done(drawn.files[i], key);
        }
        drawn.halves[i] = read_exr(drawn.files[i]);
    }
    own.reference = format_text("%s %s, two halves of %u spp each, seeds of their own", method_.peer.c_str(),
                                about_.version.c_str(), method_.own_reference_spp);
    own.reference_noise_relmse = compare(drawn.halves[0], drawn.halves[1]).relmse / 4;
    on.own = std::move(drawn);
}

void PeerMethod::prepare(const StudyPlan::Scene& scene, const Reference& reference, MethodOnScene& known,
                         MethodOnScene& own)
{
    OnScene& on = scenes_[scene.name];
    known.left_out = missing_;
    on.problem = problem_;
    if (known.left_out.empty()) on.size = size_of(scene.options, known.left_out);
    if (known.left_out.empty() && !reference.box_filter)
        known.left_out = "another program draws with a box filter of one pixel; this scene is not drawn so";
    try {
        if (known.left_out.empty() && on.problem.empty()) choose_samples(scene, reference, on, known);
        if (work_.signals.interrupted()) return;
        if (known.left_out.empty() && on.problem.empty() && has_own_reference())
            draw_own_reference(scene, reference, on, own);
    } catch (const Error& e) {
        on.problem = e.what();
    }
    if (!known.left_out.empty()) own.left_out = "as " + method_.name + " is";
    if (method_.throughput_only)
        known.not_ranked = "throughput only";
    else if (!about_.seeds)
        known.not_ranked = "the same samples in every run, so that their spread says nothing of the error";
}

std::optional<RunResult> PeerMethod::run(const StudyPlan::Scene& scene, uint64_t seed, const Reference& reference)
{
    const OnScene& on = scenes_.at(scene.name);
    RunResult result;
    result.runs.push_back({scene.name, method_.name, seed, {}, false, on.problem});
    if (has_own_reference()) result.runs.push_back({scene.name, own_name(method_.name), seed, {}, false, on.problem});
    const auto failed = [&](const std::string& problem) {
        for (StudyRun& run : result.runs) run.failed = true, run.problem = problem, run.points.clear();
        result.picture.reset();
        return result;
    };
    if (!on.problem.empty()) return failed(on.problem);
    const Order order{.name = work_.file("runs/" + scene.name + "." + method_.name + "." + std::to_string(seed)),
                      .samples = on.samples,
                      .seed = seed};
    const std::string last = picture(order.name, on.samples.back());
    std::string key = key_of(reference, on, order);
    if (on.own)
        for (const std::string& file : on.own->files) key += " " + file;
    try {
        if (!is_done(last, key)) {
            unmark(last);
            const Outcome outcome = start(scene, on, order);
            if (work_.signals.interrupted()) return {};
            if (!outcome.problem.empty()) return failed(outcome.problem);
            std::vector<Image> pictures;
            for (const uint32_t n : on.samples) pictures.push_back(read_exr(picture(order.name, n)));
            write_text(order.name + ".csv", rows_text(outcome.records, pictures, reference));
            if (on.own) write_text(order.name + ".own.csv", rows_text(outcome.records, pictures, *on.own));
            for (const uint32_t n : on.samples)
                if (n != on.samples.back()) fs::remove(picture(order.name, n));
            mark_done(last, key);
        }
        const auto records = read_peer_records(method_.peer, read_input_text(order.name + ".jsonl"), on.samples);
        result.biases = records.back().biases;
        result.picture = {last, static_cast<double>(records.back().spp), records.back().render_wall_s};
        result.runs[0].points = points_of(order.name + ".csv");
        if (on.own) result.runs[1].points = points_of(order.name + ".own.csv");
    } catch (const Error& e) {
        return failed(e.what());
    }
    return result;
}

}  // namespace lancer
