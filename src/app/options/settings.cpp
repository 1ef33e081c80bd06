#include "app/options/settings.h"

#include "app/options/option_values.h"
#include "app/paths.h"
#include "core/hash.h"
#include "integrators/integrator.h"
#include "report/stats_json.h"
#include "scene/description/render_options.h"

namespace lancer {
namespace {

// What belongs to the older programs besides their integrators: the pixel filter, and when pixels end.
void use_legacy_defaults(RenderSettings& s)
{
    if (!s.legacy) return;
    if (!knows_legacy()) fail_usage("legacy: this build of lancer was made with LANCER_WITH_CLASSIC=OFF");
    const bool is_course = is_classic(s.integrator);
    if (!s.is_given(&RenderSettings::filter))
        s.filter = s.spp == 1 ? FilterKind::centre : is_course ? FilterKind::box : FilterKind::narrow_gaussian;
    if (!s.is_given(&RenderSettings::stop)) s.stop = s.spp > 1 && s.integrator == IntegratorKind::whitted;
}

}  // namespace

RenderSettings resolve_settings(const RenderSettings& command_line, const RenderSettings& scene)
{
    RenderSettings s = scene;
    override_with(s, command_line);
    use_legacy_defaults(s);
    s.max_depth = max_depth_of(make_integrator(s));
    return s;
}

void require_denoisable(const RenderSettings& s)
{
    if (s.legacy || (s.integrator != IntegratorKind::path && s.integrator != IntegratorKind::direct))
        fail_usage("denoise: works with the integrators path and direct, and not with legacy");
    if (s.spp < 2) fail_usage("denoise: needs two halves of the samples; --spp must be at least 2");
}

void require_layers(const RenderSettings& s)
{
    if (s.legacy || s.integrator == IntegratorKind::ao)
        fail_usage("--aov: lights, parts and lobes do not work with " +
                   std::string(s.legacy ? "legacy" : "the integrator ao"));
}

PixelGrid pixel_grid(const RenderSettings& s)
{
    if (!s.legacy) return PixelGrid::centres;
    return is_classic(s.integrator) ? PixelGrid::corners : PixelGrid::shifted;
}

ToneMap usual_tonemap(const RenderSettings& s)
{
    if (!s.legacy) return ToneMap::srgb;
    return is_classic(s.integrator) ? ToneMap::clamped : ToneMap::gamma22;
}

Exposure usual_exposure(const std::string& scene_file, const RenderSettings& s)
{
    return {.is_automatic = is_mesh(scene_file) && !s.legacy};
}

std::string reproducing_options(const RenderSettings& s)
{
    std::string text;
    for (const RenderOption& row : render_options()) {
        if (row.name == "spp" || (row.is_switch() && is_default(s, row) && !is_given(s, row))) continue;
        const std::string value = value_text(s, row);
        text += text.empty() ? "" : " ";
        text += row.is_switch() ? "--set " + std::string(row.name) + "=" + value : option_name(row) + " " + value;
    }
    return text;
}

std::string settings_hash(RenderSettings s, const std::string& camera)
{
    s.given = 0;  // a default that was given is a default
    return to_hex(hash_bytes(reproducing_options(s) + " --camera " + camera + " --spp " + std::to_string(s.spp)));
}

}  // namespace lancer
