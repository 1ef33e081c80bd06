#include "report/study/json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "report/study/check.h"
#include "report/study/ranking.h"
#include "report/study/statistics.h"

namespace lancer {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* schema = "lancer.study/1";

constexpr std::array<std::pair<const char*, double ErrorPoint::*>, 7> figures{
    {{"wall_s", &ErrorPoint::wall_s},
     {"cpu_s", &ErrorPoint::cpu_s},
     {"rmse", &ErrorPoint::rmse},
     {"relmse", &ErrorPoint::relmse},
     {"relmse_trimmed", &ErrorPoint::relmse_trimmed},
     {"smape", &ErrorPoint::smape},
     {"flip", &ErrorPoint::flip}}};
constexpr std::array<std::pair<const char*, uint64_t ErrorPoint::*>, 3> rays{
    {{"rays_camera", &ErrorPoint::rays_camera},
     {"rays_bounce", &ErrorPoint::rays_bounce},
     {"rays_shadow", &ErrorPoint::rays_shadow}}};

Json number_json(double x)
{
    if (std::isnan(x)) return nullptr;
    if (std::isinf(x)) return x > 0 ? "infinity" : "-infinity";
    return x;
}

Json point_json(const ErrorPoint& p)
{
    Json json{{"spp", p.spp}};
    for (const auto& [key, member] : figures) json[key] = number_json(p.*member);
    for (const auto& [key, member] : rays) json[key] = p.*member;
    return json;
}

Json run_json(const StudyRun& run)
{
    Json points = Json::array();
    for (const ErrorPoint& p : run.points) points.push_back(point_json(p));
    return {{"scene", run.scene},   {"method", run.method},   {"seed", run.seed},
            {"failed", run.failed}, {"problem", run.problem}, {"points", std::move(points)}};
}

Json interval_json(const Interval& i) { return Json::array({number_json(i.low), number_json(i.high)}); }

Json level_json(const PictureLevel& level)
{
    Json ratio = Json::array(), intervals = Json::array();
    for (size_t c = 0; c < 3; ++c) {
        ratio.push_back(number_json(level.ratio[c]));
        intervals.push_back(interval_json(level.ratio_interval[c]));
    }
    return {{"scene", level.scene},
            {"method", level.method},
            {"pictures", level.pictures},
            {"ratio", ratio},
            {"ratio_interval", intervals},
            {"systematic_relmse", number_json(level.systematic_relmse)},
            {"systematic_interval", interval_json(level.systematic_interval)}};
}

// Derived values of the page, for other programs; not read back.
Json time_ratios_json(const Study& study)
{
    Json all = Json::array();
    for (const StudyScene& scene : study.scenes)
        for (const StudyMethod& m : study.methods)
            for (const double target : study_targets) {
                if (m.name == study.baseline) continue;
                const Comparison c = speed_up(study, scene, m, target);
                all.push_back({{"scene", scene.name},
                               {"method", m.name},
                               {"relmse", target},
                               {"baseline_over_method", number_json(c.ratio)},
                               {"interval", std::isnan(c.ratio) ? Json() : interval_json(c.interval)},
                               {"verdict", rank_text(c)}});
            }
    return all;
}

// The same, over all scenes.
Json geometric_means_json(const Study& study)
{
    Json all = Json::array();
    for (const StudyMethod& m : study.methods) {
        if (m.name == study.baseline) continue;
        const Overview overview = overview_of(study, m);
        for (const auto& [what, mean] :
             {std::pair{"time to equal error", &overview.mean_time}, {"FLIP at equal time", &overview.mean_flip}})
            all.push_back({{"method", m.name},
                           {"of", what},
                           {"baseline_over_method", number_json(mean->ratio)},
                           {"interval", std::isnan(mean->ratio) ? Json() : interval_json(mean->interval)},
                           {"verdict", rank_text(*mean)}});
    }
    return all;
}

// A value and how one gets to it, for messages.
struct Node {
    const Json& json;
    const std::string& file;
    std::string path;

    Error wrong(const std::string& why) const
    {
        return {ErrorKind::invalid_input, {file}, (path.empty() ? "" : path + ": ") + why};
    }
    Node at(const char* key) const
    {
        if (!json.is_object()) throw wrong("not an object");
        const auto found = json.find(key);
        if (found == json.end()) throw wrong(std::string("no \"") + key + "\"");
        return {*found, file, path.empty() ? key : path + "." + key};
    }
    std::vector<Node> list() const
    {
        if (!json.is_array()) throw wrong("not an array");
        std::vector<Node> nodes;
        for (size_t i = 0; i < json.size(); ++i) nodes.push_back({json[i], file, path + "[" + std::to_string(i) + "]"});
        return nodes;
    }
    std::string text() const
    {
        if (!json.is_string()) throw wrong("not a text");
        return json.get<std::string>();
    }
    bool flag() const
    {
        if (!json.is_boolean()) throw wrong("neither true nor false");
        return json.get<bool>();
    }
    uint64_t count() const
    {
        if (!json.is_number_unsigned()) throw wrong("not a whole number of 0 or more");
        return json.get<uint64_t>();
    }
    double number() const
    {
        if (json.is_null()) return no_number;
        if (json == "infinity") return std::numeric_limits<double>::infinity();
        if (json == "-infinity") return -std::numeric_limits<double>::infinity();
        if (!json.is_number()) throw wrong("not a number");
        return json.get<double>();
    }
    std::vector<std::string> texts() const
    {
        std::vector<std::string> all;
        for (const Node& node : list()) all.push_back(node.text());
        return all;
    }
};

ErrorPoint point_of(const Node& node)
{
    ErrorPoint p;
    const Node spp = node.at("spp");
    if (spp.count() > std::numeric_limits<uint32_t>::max()) throw spp.wrong("too large");
    p.spp = static_cast<uint32_t>(spp.count());
    for (const auto& [key, member] : figures) p.*member = node.at(key).number();
    for (const auto& [key, member] : rays) p.*member = node.at(key).count();
    return p;
}

StudyRun run_of(const Node& node)
{
    StudyRun run{node.at("scene").text(),  node.at("method").text(), node.at("seed").count(), {},
                 node.at("failed").flag(), node.at("problem").text()};
    for (const Node& point : node.at("points").list()) run.points.push_back(point_of(point));
    return run;
}

Interval interval_of(const Node& node)
{
    const std::vector<Node> ends = node.list();
    if (ends.size() != 2) throw node.wrong("not two numbers");
    return {ends[0].number(), ends[1].number()};
}

PictureLevel level_of(const Node& node)
{
    PictureLevel level;
    level.scene = node.at("scene").text(), level.method = node.at("method").text();
    level.pictures = node.at("pictures").count();
    const std::vector<Node> ratio = node.at("ratio").list(), intervals = node.at("ratio_interval").list();
    if (ratio.size() != 3 || intervals.size() != 3) throw node.wrong("not three channels");
    for (size_t c = 0; c < 3; ++c) {
        level.ratio[c] = ratio[c].number();
        level.ratio_interval[c] = interval_of(intervals[c]);
    }
    level.systematic_relmse = node.at("systematic_relmse").number();
    level.systematic_interval = interval_of(node.at("systematic_interval"));
    return level;
}

MethodOnScene on_scene_of(const Node& node)
{
    return {node.at("scene").text(),      node.at("method").text(),    node.at("left_out").text(),
            node.at("not_ranked").text(), node.at("reference").text(), node.at("reference_noise_relmse").number()};
}

Error not_json(const std::string& name, const std::string& json, size_t byte)
{
    const std::string before = json.substr(0, byte ? byte - 1 : 0);
    const size_t line_begin = before.find_last_of('\n') + 1;  // 0 if there is none
    const auto line = static_cast<uint32_t>(std::count(before.begin(), before.end(), '\n') + 1);
    return {ErrorKind::invalid_input,
            {name, line, static_cast<uint32_t>(before.size() - line_begin + 1)},
            before.size() >= json.size() ? "not JSON: it ends too early" : "not JSON"};
}

Json parsed(const std::string& name, const std::string& json)
{
    try {
        return Json::parse(json);
    } catch (const Json::parse_error& e) {
        throw not_json(name, json, e.byte);
    } catch (const Json::exception&) {
        throw Error(ErrorKind::invalid_input, {name}, "not JSON: a number that is too large");
    }
}

}  // namespace

std::string to_json(const Study& study)
{
    Json scenes = Json::array(), methods = Json::array(), runs = Json::array(), machine = Json::array();
    for (const StudyScene& s : study.scenes)
        scenes.push_back({{"name", s.name},
                          {"description", s.description},
                          {"reference", s.reference},
                          {"reference_noise_relmse", number_json(s.reference_noise_relmse)}});
    for (const StudyMethod& m : study.methods)
        methods.push_back({{"name", m.name},
                           {"description", m.description},
                           {"biases", m.biases},
                           {"peer", m.peer},
                           {"version", m.version}});
    for (const auto& [key, value] : study.machine) machine.push_back({{"name", key}, {"value", value}});
    for (const StudyRun& run : study.runs) runs.push_back(run_json(run));
    Json on_scenes = Json::array(), levels = Json::array();
    for (const MethodOnScene& e : study.on_scenes)
        on_scenes.push_back({{"scene", e.scene},
                             {"method", e.method},
                             {"left_out", e.left_out},
                             {"not_ranked", e.not_ranked},
                             {"reference", e.reference},
                             {"reference_noise_relmse", number_json(e.reference_noise_relmse)}});
    for (const PictureLevel& level : study.levels) levels.push_back(level_json(level));
    const Json all{{"schema", schema},
                   {"title", study.title},
                   {"baseline", study.baseline},
                   {"machine", machine},
                   {"not_comparable", study.not_comparable},
                   {"scenes", scenes},
                   {"methods", methods},
                   {"on_scenes", on_scenes},
                   {"levels", levels},
                   {"time_to_error_ratio_to_baseline", time_ratios_json(study)},
                   {"geometric_means", geometric_means_json(study)},
                   {"runs", runs}};
    return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Study read_study(const std::string& name, const std::string& json)
{
    const Json parsed_json = parsed(name, json);
    const Node all{parsed_json, name, ""};
    if (const Node found = all.at("schema"); found.text() != schema)
        throw found.wrong("'" + found.text() + "', not '" + schema + "': not a study that this version reads");
    Study study;
    study.title = all.at("title").text();
    study.baseline = all.at("baseline").text();
    study.not_comparable = all.at("not_comparable").texts();
    for (const Node& n : all.at("machine").list())
        study.machine.emplace_back(n.at("name").text(), n.at("value").text());
    for (const Node& n : all.at("scenes").list())
        study.scenes.push_back({n.at("name").text(), n.at("description").text(), n.at("reference").text(),
                                n.at("reference_noise_relmse").number()});
    for (const Node& n : all.at("methods").list())
        study.methods.push_back({n.at("name").text(), n.at("description").text(), n.at("biases").texts(),
                                 n.at("peer").flag(), n.at("version").text()});
    for (const Node& n : all.at("on_scenes").list()) study.on_scenes.push_back(on_scene_of(n));
    for (const Node& n : all.at("levels").list()) study.levels.push_back(level_of(n));
    for (const Node& n : all.at("runs").list()) study.runs.push_back(run_of(n));
    check_study(name, study);
    return study;
}

}  // namespace lancer
