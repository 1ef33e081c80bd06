#include "report/study/check.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/error.h"

namespace lancer {
namespace {

template <class Named>
std::set<std::string> names_of(const std::string& file, const char* what, const std::vector<Named>& list)
{
    std::set<std::string> names;
    for (const Named& one : list) {
        if (one.name.empty()) throw Error(ErrorKind::invalid_input, {file}, std::string("a ") + what + " has no name");
        if (!names.insert(one.name).second)
            throw Error(ErrorKind::invalid_input, {file},
                        std::string("two ") + what + "s are called '" + one.name + "'");
    }
    return names;
}

std::string name_of(const StudyRun& run)
{
    return "the run of '" + run.method + "' on '" + run.scene + "' with seed " + std::to_string(run.seed);
}

}  // namespace

const MethodOnScene& Study::on_scene(const std::string& scene, const std::string& method) const
{
    static const MethodOnScene nothing;
    const auto found = std::find_if(on_scenes.begin(), on_scenes.end(),
                                    [&](const auto& e) { return e.scene == scene && e.method == method; });
    return found == on_scenes.end() ? nothing : *found;
}

void check_points(const std::string& name, const StudyRun& run)
{
    const ErrorPoint* before = nullptr;
    for (const ErrorPoint& p : run.points) {
        const auto refuse = [&](const std::string& why) {
            return Error(ErrorKind::invalid_input, {name},
                         name_of(run) + ": " + why + " at " + std::to_string(p.spp) + " samples per pixel");
        };
        if (p.spp == 0) throw refuse("no sample");
        if (!(p.wall_s >= 0) || std::isinf(p.wall_s)) throw refuse("wall seconds that are no time");
        if (p.cpu_s < 0 || std::isinf(p.cpu_s)) throw refuse("CPU seconds that are no time");
        if (before && p.spp <= before->spp) throw refuse("no more samples than before");
        if (before && p.wall_s < before->wall_s) throw refuse("less time than before");
        if (p.rmse < 0 || p.smape < 0 || p.flip < 0) throw refuse("a negative error");
        before = &p;
    }
}

void check_study(const std::string& name, const Study& study)
{
    const auto refuse = [&](const std::string& why) { return Error(ErrorKind::invalid_input, {name}, why); };
    const std::set<std::string> scenes = names_of(name, "scene", study.scenes);
    const std::set<std::string> methods = names_of(name, "method", study.methods);
    for (const StudyScene& s : study.scenes)
        if (!(s.reference_noise_relmse >= 0) || std::isinf(s.reference_noise_relmse))
            throw refuse("scene '" + s.name + "': the noise of its reference is no error");
    if (!study.baseline.empty() && methods.count(study.baseline) == 0)
        throw refuse("the baseline '" + study.baseline + "' is none of the methods");
    const auto check_pairs = [&](const auto& list, const char* what) {
        std::set<std::pair<std::string, std::string>> pairs;
        for (const auto& e : list) {
            const std::string name_of_pair = "'" + e.method + "' on '" + e.scene + "'";
            if (scenes.count(e.scene) == 0 || methods.count(e.method) == 0)
                throw refuse(std::string(what) + " of " + name_of_pair + ": there is no such scene or method");
            if (!pairs.insert({e.scene, e.method}).second)
                throw refuse(std::string(what) + " of " + name_of_pair + " is there twice");
        }
    };
    check_pairs(study.on_scenes, "the remark");
    check_pairs(study.levels, "the level");
    for (const MethodOnScene& e : study.on_scenes)
        if (!(e.reference_noise_relmse >= 0) || std::isinf(e.reference_noise_relmse))
            throw refuse("the remark of '" + e.method + "' on '" + e.scene +
                         "': the noise of its reference is no error");
    std::set<std::tuple<std::string, std::string, uint64_t>> known;
    for (const StudyRun& run : study.runs) {
        if (scenes.count(run.scene) == 0) throw refuse(name_of(run) + ": there is no such scene");
        if (methods.count(run.method) == 0) throw refuse(name_of(run) + ": there is no such method");
        if (!known.insert({run.scene, run.method, run.seed}).second) throw refuse(name_of(run) + " is there twice");
        check_points(name, run);
    }
}

}  // namespace lancer
