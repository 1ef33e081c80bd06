#include "app/render/identity.h"

#include "app/console.h"
#include "app/load_scene.h"
#include "app/options/settings.h"
#include "app/render/recipe.h"
#include "core/hash.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

// Whose camera, and how the command line changes it.
std::string view_text(const SceneChoice& view) { return view.camera + view_options_text(view); }

}  // namespace

RenderIdentity identity_of(const RenderOptions& options, const RunStats& stats, const std::optional<SetDeal>& sets)
{
    const RunStats::Context& c = stats.context;
    const RenderSettings& settings = stats.settings.render;
    const Tile& crop = stats.settings.crop;
    const SceneChoice& scene = options.picture.scene;
    RenderIdentity all{{"lancer", c.version + ", " + c.compiler + ", " + c.instructions},
                       {"embree", c.embree},
                       {"scene", to_hex(stats.scene.content_hash)},
                       {"view", view_text(scene)},
                       {"crop", format_text("%u,%u,%u,%u", crop.x0, crop.y0, crop.x1, crop.y1)}};
    for (const RenderOption& option : render_options())
        if (option.name != "spp" || settings.stop) all.emplace_back(option.name, value_text(settings, option));
    std::string& aovs = all.emplace_back("aov", "").second;
    for (const Aov aov : options.aovs) aovs += (aovs.empty() ? "" : ",") + std::string(name_of(aov));
    all.emplace_back("layers", std::string(options.light_layers ? "lights " : "") +
                                   (options.part_layers ? "parts " : "") + (options.lobe_layers ? "lobes " : "") +
                                   (options.mattes ? "cryptomatte" : ""));
    all.emplace_back("background", name_of(options.background));
    all.emplace_back("halves to denoise", sets ? format_text("of %u sets", sets->count()) : "none");
    return all;
}

std::string frame_identity(const RenderOptions& options, const RunStats& stats, const OutputDescription& output)
{
    uint64_t hash = hash_of_contents(options);
    const auto add = [&](const std::string& text) { hash = hash_bytes(text, hash); };
    for (const auto& [name, value] : identity_of(options, stats, sets_of(options, stats.settings.render)))
        if (name != "accel") add(name + "=" + value);  // all give the same picture, and which one is not chosen yet
    add("spp=" + std::to_string(stats.settings.render.spp));
    for (const auto& limit : {options.time, options.error}) add(limit ? shortest(*limit) : "none");
    const Exposure exposure = output.exposure.value_or(Exposure{});
    add((exposure.is_automatic ? "auto" : shortest(exposure.stops)) + " " +
        (output.tonemap ? std::string(name_of(*output.tonemap)) : ""));
    return to_hex(hash);
}

std::string hash_of_settings(const RenderSettings& settings, const SceneChoice& view)
{
    return settings_hash(settings, view_text(view));
}

}  // namespace lancer
