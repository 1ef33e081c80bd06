#include "app/render/summary.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "app/console.h"
#include "app/options/settings.h"
#include "app/specialisation.h"
#include "core/names.h"

namespace lancer {
namespace {

void print_settings(const RunStats& stats, const RenderSettings& settings)
{
    const RunStats::SceneFigures& c = stats.scene;
    print_note(
        format_text("%s: %zu triangles, %zu meshes, %zu instances, %zu spheres, %zu planes, %zu lights, %zu "
                    "materials",
                    c.file.c_str(), c.triangles, c.meshes, c.instances, c.spheres, c.planes, c.lights, c.materials));
    print_note(reproducing_options(settings) +
               format_text(" --spp %u --threads %u", settings.spp, stats.settings.threads));
}

void print_specialisation(const RunStats& stats)
{
    print_note("kernel '" + stats.settings.kernel + "'; unused features:");
    for (const UnusedFeature& l : stats.scene.unused_features) print_note("  " + to_string(l));
}

// What shows one sample, with every vertex.
std::string pixel_command(const SampleId& id, const RenderSettings& settings, const SceneChoice& scene)
{
    return "lancer pixel " + in_shell_quotes(scene.file) + format_text(" %u %u %u ", id.x, id.y, id.sample) +
           reproducing_options(settings) + options_text(scene);
}

}  // namespace

void print_start(const RunStats& stats, const RenderSettings& settings)
{
    print_settings(stats, settings);
    print_specialisation(stats);
}

void print_sampling_plan(const AnyIntegrator& integrator, const SamplingPlan& plan)
{
    const auto open = static_cast<size_t>(std::count(plan.background_only.begin(), plan.background_only.end(), 1));
    if (open)
        print_note(format_text("background only: %zu of %zu cells of %u pixels; their camera rays are not traced", open,
                               plan.background_only.size(), plan.background_cell));
    if (!std::holds_alternative<Path>(integrator)) return;
    print_note(format_text("sampling plan: paths split into %u", plan.split) + "; Russian roulette by " +
               (plan.importance.empty() ? std::string("the throughput")
                                        : format_text("an importance map, cells of %u pixels", plan.cell)));
}

void print_dropped_samples(const RunStats& stats, const RenderSettings& settings, const SceneChoice& scene)
{
    const auto& first = stats.counters.first_dropped;
    if (!first) return;
    print_problem(format_text("warning: dropped samples, as they were not finite: %zu; to see the first one:\n  ",
                              stats.counters.dropped) +
                  pixel_command(*first, settings, scene));
}

void print_error_sources(const ErrorSources& sources, const RenderSettings& settings, const SceneChoice& scene)
{
    if (sources.outliers.empty()) return print_note("no outliers: the samples of each pixel agree");
    const auto print_shares = [](const std::string& title, const std::vector<ErrorShare>& shares) {
        print_note(title);
        for (const ErrorShare& e : shares)
            if (std::abs(e.share) >= 0.005) print_note(format_text("  %5.1f %%  ", 100 * e.share) + e.name);
    };
    print_shares("error by path: surfaces between light and camera, where the light comes from, what found it",
                 sources.classes);
    print_shares("error by the material that is seen", sources.materials);
    print_note("samples with the largest part of the error:");
    for (const Outlier& o : sources.outliers)
        print_note(format_text("  %6.2f %%  pixel %u %u sample %u: luminance %.3g, in a pixel of %.3g; ", 100 * o.share,
                               o.id.x, o.id.y, o.id.sample, o.luminance, o.mean) +
                   o.light + (o.material.empty() ? "" : ", " + in_quotes(o.material)));
    print_note(
        format_text("no other sample has more than %.2g %%; to see the first one:\n  ", 100 * sources.others_at_most) +
        pixel_command(sources.outliers[0].id, settings, scene));
}

void print_summary(const RunStats& stats, const RenderOptions& options, const std::optional<Metrics>& metrics)
{
    const Counters& c = stats.counters;
    const double rays = static_cast<double>(stats.rays());
    std::string error;
    if (const auto& interval = stats.estimated_interval)
        error = format_text(", error %.3g [%.3g, %.3g]", *stats.estimated_error, interval->low, interval->high);
    else if (stats.estimated_error)
        error = format_text(", error < ~%.3g", *stats.estimated_error);
    print_note(format_text("%zu rays: %zu camera, %zu bounce, %zu shadow; %.2f Mrays/s", stats.rays(), c.camera_rays,
                           c.bounce_rays, c.shadow_rays, stats.render_s > 0 ? 1e-6 * rays / stats.render_s : 0) +
               error);
    if (const auto& interval = stats.denoised_interval)
        print_note(
            format_text("denoised: error %.3g [%.3g, %.3g], told by samples held out; of the noisy picture: above",
                        *stats.denoised_error, interval->low, interval->high));
    else if (stats.denoised)
        print_note("denoised: --replicates 8 would tell the error of this picture; the noisy one's is above");
    else if (options.denoise)
        print_note("not denoised: the picture is partial");
    if (const uint64_t hidden = stats.scene.hidden_lights)
        print_note(format_text("%zu light%s do%s not reach the picture; the warnings say which and why", size_t{hidden},
                               hidden == 1 ? "" : "s", hidden == 1 ? "es" : ""));
    if (!stats.stopped_by.empty())
        print_note(format_text("stopped by --%s at %u spp", stats.stopped_by.c_str(), stats.settings.render.spp));
    if (const auto& m = metrics)
        print_note(format_text("against %s: rmse %.3g, relmse %.3g, without the worst 0.1 %% of pixels %.3g",
                               options.reference.c_str(), m->rmse, m->relmse, m->relmse_trimmed));
    std::string phases;
    for (const auto& p : stats.phases) phases += (phases.empty() ? "" : ", ") + p.name + format_text(" %.2f", p.wall_s);
    print_note("seconds: " + phases);
}

}  // namespace lancer
