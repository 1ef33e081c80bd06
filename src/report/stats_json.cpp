#include "report/stats_json.h"

#include <nlohmann/json.hpp>

#include "scene/description/render_options.h"

namespace lancer {
namespace {

using Json = nlohmann::ordered_json;

// A rate over no time is not known.
Json rate(uint64_t count, double seconds)
{
    return seconds > 0 ? Json(static_cast<double>(count) / seconds) : Json(nullptr);
}

Json or_null(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

Json context_of(const RunStats& s)
{
    const RunStats::Context& c = s.context;
    return {{"version", c.version},
            {"embree", c.embree},
            {"parallel", c.parallel},
            {"compiler", c.compiler},
            {"build_type", c.build_type},
            {"instructions", c.instructions},
            {"isa", std::string(name_of(s.settings.render.isa))},
            {"cpu", c.cpu},
            {"threads", s.settings.threads},
            {"load_average", or_null(c.load_average)},
            {"command_line", c.command_line}};
}

Json unused_features_of(const std::vector<UnusedFeature>& all)
{
    Json json = Json::array();
    for (const UnusedFeature& l : all) json.push_back({{"what", l.what}, {"count", l.count}, {"bytes", l.bytes}});
    return json;
}

Json scene_of(const RunStats::SceneFigures& s)
{
    return {{"file", s.file},
            {"content_hash", to_hex(s.content_hash)},
            {"triangles", s.triangles},
            {"meshes", s.meshes},
            {"instances", s.instances},
            {"spheres", s.spheres},
            {"planes", s.planes},
            {"lights", s.lights},
            {"materials", s.materials},
            {"accelerator_bytes", s.accelerator_bytes},
            {"hidden_lights", s.hidden_lights},
            {"unused_features", unused_features_of(s.unused_features)},
            {"added_light", s.added_light.empty() ? Json(nullptr) : Json(s.added_light)},
            {"warnings", s.warnings}};
}

Json json_of(const RenderSettings& settings, const RenderOption& option)
{
    return std::visit(
        [&]<class Field>(const Field& field) -> Json {
            if constexpr (requires { settings.*field.member + 1; })  // a number, true or false
                return settings.*field.member;
            else
                return value_text(settings, option);
        },
        option.field);
}

// Switches stand in an object of their own, and a size is two numbers.
Json settings_of(const RunStats::SettingsUsed& s)
{
    Json json{{"width", s.render.size.width}, {"height", s.render.size.height}}, switches;
    for (const RenderOption& option : render_options()) {
        if (std::holds_alternative<SizeField>(option.field)) continue;
        (option.is_switch() ? switches : json)[std::string(option.name)] = json_of(s.render, option);
    }
    json["switches"] = switches;
    json["crop"] = {s.crop.x0, s.crop.y0, s.crop.x1, s.crop.y1};
    json["kernel"] = s.kernel;
    json["threads"] = s.threads;
    json["tile"] = s.tile;
    json["batch"] = s.batch;
    json["hash"] = s.hash;
    return json;
}

Json rays_of(const RunStats& s)
{
    const auto kind = [&](uint64_t count) { return Json{{"count", count}, {"per_second", rate(count, s.render_s)}}; };
    return {{"camera", kind(s.counters.camera_rays)},
            {"bounce", kind(s.counters.bounce_rays)},
            {"shadow", kind(s.counters.shadow_rays)},
            {"all", kind(s.rays())}};
}

Json samples_of(const RunStats& s)
{
    Json dropped{{"count", s.counters.dropped}};
    if (const auto& first = s.counters.first_dropped)
        dropped["first"] = {{"x", first->x}, {"y", first->y}, {"sample", first->sample}};
    return {{"count", s.samples},
            {"background_only", s.counters.background_only_samples},
            {"per_second", rate(s.samples, s.render_s)},
            {"dropped", dropped}};
}

Json error_sources_of(const ErrorSources& s)
{
    Json outliers = Json::array();
    for (const Outlier& o : s.outliers)
        outliers.push_back({{"x", o.id.x},
                            {"y", o.id.y},
                            {"sample", o.id.sample},
                            {"luminance", o.luminance},
                            {"pixel_mean", o.mean},
                            {"share", o.share},
                            {"light", o.light},
                            {"material", o.material}});
    const auto shares = [](const std::vector<ErrorShare>& of) {
        Json json = Json::array();
        for (const ErrorShare& e : of) json.push_back({{"name", e.name}, {"share", e.share}});
        return json;
    };
    return {{"outliers", outliers},
            {"others_at_most", s.others_at_most},
            {"by_class", shares(s.classes)},
            {"by_material", shares(s.materials)}};
}

}  // namespace

std::string to_json(const RunStats& s)
{
    Json phases = Json::array(), analyses = Json::array(), passes = Json::array();
    for (const auto& p : s.phases)
        phases.push_back({{"name", p.name},
                          {"wall_s", p.wall_s},
                          {"cpu_s", p.cpu_s},
                          {"resident_bytes", p.resident_bytes},
                          {"peak_bytes", p.peak_bytes}});
    for (const auto& a : s.analyses) analyses.push_back({{"name", a.name}, {"wall_s", a.wall_s}});
    for (const auto& p : s.passes)
        passes.push_back({{"spp", p.spp}, {"seconds", p.seconds}, {"error", or_null(p.error)}});
    const auto bounds = [](const std::optional<Interval>& i) { return i ? Json{i->low, i->high} : Json(nullptr); };
    Json all{{"schema", "lancer.stats/1"},
             {"context", context_of(s)},
             {"scene", scene_of(s.scene)},
             {"settings", settings_of(s.settings)},
             {"phases", phases},
             {"analyses", analyses},
             {"memory", {{"peak_bytes", s.peak_memory_bytes}}},
             {"rays", rays_of(s)},
             {"samples", samples_of(s)},
             {"passes", passes},
             {"estimated_error", or_null(s.estimated_error)},
             {"estimated_interval", bounds(s.estimated_interval)},
             {"stopped_by", s.stopped_by.empty() ? Json(nullptr) : Json(s.stopped_by)},
             {"partial", s.partial}};
    if (s.denoised) all["denoised"] = {{"error", or_null(s.denoised_error)}, {"interval", bounds(s.denoised_interval)}};
    if (s.error_sources) all["error_sources"] = error_sources_of(*s.error_sources);
    // A file name need not be UTF-8; the text must be.
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_hex(uint64_t x)
{
    std::string text(16, '0');
    for (size_t i = text.size(); i-- > 0; x >>= 4) text[i] = "0123456789abcdef"[x & 15];
    return text;
}

}  // namespace lancer
