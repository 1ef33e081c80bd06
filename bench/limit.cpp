// bench_limit: how much of a render is the tracing of its rays. The time inside of the accelerator is clocked; the rays
// of the render are traced again by lancer's accelerator, as they were, and by nothing but Embree; and a bare path
// tracer draws the same scene where it can.
#include <algorithm>
#include <cmath>

#include "app/bench/rays.h"
#include "app/console.h"
#include "core/parallel.h"
#include "harness/bare_loop.h"
#include "harness/inside.h"
#include "harness/scenes.h"
#include "report/metrics/picture_pairs.h"
#include "report/metrics/statistics.h"

namespace lancer::bench {
namespace {

struct Counted {
    std::vector<Ray> closest, any;  // in the order of the render
};

Counted split(const RayRecording& recording)
{
    Counted c;
    for (const RayRecording::Batch& b : recording.batches) {
        const auto first = recording.rays.begin() + static_cast<std::ptrdiff_t>(b.first);
        auto& to = b.occlusion ? c.any : c.closest;
        to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(b.count));
    }
    return c;
}

// With the batches of the render. hits, occluded: room for the answers.
void trace_again(const RayRecording& recording, const Accelerator& accel, std::span<Hit> hits,
                 std::span<uint8_t> occluded)
{
    for (const RayRecording::Batch& b : recording.batches) {
        const std::span<const Ray> rays = std::span(recording.rays).subspan(b.first, b.count);
        if (b.occlusion)
            accel.any(rays, occluded.first(b.count));
        else
            accel.closest(rays, hits.first(b.count), b.coherence);
    }
}

double mean_luminance(const std::vector<Color>& picture)
{
    double sum = 0;
    for (const Color c : picture) sum += double{luminance(c)};
    return sum / static_cast<double>(picture.size());
}

// Not empty.
void add_share(Json& row, std::span<const RenderTime> renders)
{
    std::vector<double> shares;
    for (const RenderTime& r : renders) shares.push_back(r.share());
    const Spread share = spread_of(shares);
    row["share"] = share.median, row["share_low"] = share.min, row["share_high"] = share.max;
}

void measure_scene(const BenchScene& scene, const Options& options, Report& report)
{
    const SceneDescription description = scene.load();
    RenderSettings picture = scene.options(options.full ? 192 : 96);
    const Stage stage(description, picture);
    const uint32_t spp = samples_per_block;
    const Geometry& g = stage.scene.geometry;
    const std::vector<Tile> tiles = stage.tiles();

    if (stage.scene.triangle_count() == 0) return;  // nothing that bare Embree has

    const BareEmbree bare(g, {});
    const RayRecording recording = record_rays(stage.source(), stage.renderer.integrator(), tiles, spp);
    const Counted rays = split(recording);
    const std::optional<BareLoop> loop = BareLoop::make(description, stage, bare);

    const double samples = static_cast<double>(stage.settings.size.width) * stage.settings.size.height * spp;
    std::vector<Hit> hits(rays.closest.size());
    std::vector<uint8_t> occluded(rays.any.size());
    std::vector<RenderTime> clocked;  // of each round, the one to warm up before them
    std::vector<Contestant> contestants{
        {"render", samples, [&] { stage.draw(spp); }},
        {"inside",
         samples,
         {},
         [&] {
             clocked.push_back(clock_render(stage, spp));
             return clocked.back().inside;
         }},
        {"accelerator", samples, [&] { trace_again(recording, stage.renderer.accelerator(), hits, occluded); }},
        {"rays",
         samples,
         {},
         [&] { return bare.replay_closest_ns(rays.closest, Coherence::incoherent) + bare.replay_any_ns(rays.any); }},
        {"rays-packet8", samples, [&] {
             bare.closest(rays.closest, hits, Way::packet8, Coherence::incoherent);
             bare.any(rays.any, occluded, Way::packet8, Coherence::incoherent);
         }}};
    if (loop) contestants.push_back({"bare-loop", samples, [&] { loop->render(spp, 0); }});
    const std::vector<Timing> timings = take_turns(contestants, options.repetitions, options.threads);

    std::optional<PicturePair> rendered, looped;
    std::array<double, 2> error{};
    if (loop) {
        picture.give(&RenderSettings::seed, 1);
        rendered = {pixel_means(stage.draw(spp)), pixel_means(Stage(description, picture).draw(spp))};
        looped = {pixel_means(loop->render(spp, 0)), pixel_means(loop->render(spp, 1))};
        const std::vector<Color> mean = mean_of(std::array<const PicturePair*, 2>{&*rendered, &*looped});
        error = {error_of(*rendered, mean), error_of(*looped, mean)};
    }
    const auto best = [](const Timing& t) { return *std::min_element(t.cpu.begin(), t.cpu.end()); };
    for (size_t i = 0; i < contestants.size(); ++i) {
        Json& row = report.add("limit", joined({scene.name, contestants[i].name}), timings[i], 1);
        row["threads"] = options.threads;
        row["mesh"] = scene.name, row["accel"] = std::string(name_of(stage.renderer.accelerator_kind())),
        row["way"] = contestants[i].name;
        row["rays_per_sample"] = static_cast<double>(rays.closest.size() + rays.any.size()) / samples;
        row["best"] = best(timings[i]);
        // Of the render's CPU time, best against best; what is clocked within a render is told of that one.
        row["share"] = best(timings[i]) / best(timings[0]);
        if (contestants[i].name == "inside") add_share(row, std::span(clocked).subspan(1));
        const bool is_bare = contestants[i].name.starts_with("rays");  // Embree alone, which has triangles
        if (is_bare && (!g.spheres.empty() || !g.planes.empty())) row["left_out"] = "spheres and planes";
        if (i == 0 && loop) row["error"] = error[0];
        if (contestants[i].name == "bare-loop") {
            row["error"] = error[1];
            // Plain Monte Carlo halves the squared error in twice the time: the quotient of their products.
            row["time_to_equal_error"] = error[1] * best(timings[i]) / (error[0] * best(timings[0]));
            row["mean_ratio"] = (mean_luminance((*looped)[0]) + mean_luminance((*looped)[1])) /
                                (mean_luminance((*rendered)[0]) + mean_luminance((*rendered)[1]));
        }
        add_ratio(row, "render", timings[0], timings[i], 1);
        print_row(row);
    }
}

}  // namespace
}  // namespace lancer::bench

int main(int argc, char** argv)
{
    using namespace lancer::bench;
    return run_program(
        argc, argv, "bench_limit",
        "Traces the rays of real renders again, by lancer's accelerator and by nothing but Embree, and draws the "
        "scenes with a bare path tracer where it can.\nThe share of a row is its CPU time over that of the render; the "
        "nearer to 1, the less is left to gain.",
        [](const Options& options, Report& report) {
            lancer::with_threads(options.threads, [&] {
                for (const BenchScene& scene : choose_scenes(options)) measure_scene(scene, options, report);
            });
        });
}
