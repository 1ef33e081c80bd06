// bench_render: whole pictures with each accelerator. They must have the same bits; what differs is the time.
#include "app/console.h"
#include "app/render/outputs.h"
#include "core/parallel.h"
#include "harness/scenes.h"
#include "harness/stage.h"
#include "io/image/exr.h"
#include "report/metrics/metrics.h"
#include "report/metrics/picture_pairs.h"
#include "report/metrics/statistics.h"

namespace lancer::bench {
namespace {

constexpr double most_run_ns = 1e10;  // an accelerator that takes longer for a picture draws none

// Relative mean squared error: against the references if there are any of this size, else as the samples tell it.
double squared_error(const BenchScene& scene, const Film& film)
{
    if (scene.references[0].empty() || film.height != scene.reference_height) return estimate_rel_mse(film);
    return unbiased_squared_error(to_image(film), read_exr(scene.references[0]), read_exr(scene.references[1]));
}

// A picture by one accelerator, made again and again.
struct Painter {
    std::string name;
    std::unique_ptr<Stage> stage;
    Film film;
    uint32_t spp;

    void draw() { film = stage->draw(spp); }
    // From camera rays all over the picture, at so many to a sample. Not from a piece of the picture: before the first
    // one its paths are planned, which by the slowest accelerators alone takes hours.
    double expected_ns() const
    {
        constexpr uint32_t side = 16;
        constexpr double rays_per_sample = 10;
        std::vector<Ray> rays;
        for (uint32_t i = 0; i < side * side; ++i) {
            const auto at = [](uint32_t k, uint32_t size) {
                return (static_cast<float>(k) + 0.5f) / side * static_cast<float>(size);
            };
            rays.push_back(stage->camera.ray({at(i % side, film.width), at(i / side, film.height)}, {0.5f, 0.5f}));
        }
        std::vector<Hit> hits(rays.size());
        double start = 0;
        for (int i = 0; i < 2; ++i) {  // the first time warms up
            start = all_ns();
            stage->renderer.accelerator().closest(rays, hits, Coherence::incoherent);
        }
        const double samples = static_cast<double>(film.width) * film.height * spp;
        return (all_ns() - start) / (side * side) * rays_per_sample * samples;
    }
};

void measure_scene(const BenchScene& scene, const Options& options, Report& report)
{
    const SceneDescription description = scene.load();
    RenderSettings picture = scene.options(scene.reference_height ? scene.reference_height : 180);
    std::vector<Painter> painters;
    for (const AccelName& a : accelerators) {
        const std::string name(a.name);
        if (!options.wants_accel(name)) continue;
        picture.give(&RenderSettings::accel, a.kind);
        auto stage = std::make_unique<Stage>(description, picture);
        Film film = stage->film();
        Painter painter{name, std::move(stage), std::move(film), options.full ? 64u : 16u};
        if (painter.expected_ns() <= most_run_ns)
            painters.push_back(std::move(painter));
        else
            print_note(format_text("%s: %s is too slow for a whole picture", scene.name.c_str(), name.c_str()));
    }
    if (painters.empty()) return;
    std::vector<Contestant> contestants;
    for (Painter& p : painters) {
        const double samples = static_cast<double>(p.film.width) * p.film.height * p.spp;
        contestants.push_back({p.name, samples, [&p] { p.draw(); }});
    }
    const std::vector<Timing> timings = take_turns(contestants, options.repetitions, options.threads);
    for (size_t i = 0; i < painters.size(); ++i) {
        const Painter& p = painters[i];
        Json& row = report.add("render", joined({scene.name, p.name}), timings[i], options.threads);
        row["mesh"] = scene.name, row["accel"] = p.name;
        row["width"] = p.film.width, row["height"] = p.film.height, row["spp"] = p.spp;
        const double seconds = 1e-9 * contestants[i].items * median(counted(timings[i], options.threads));
        const double error = squared_error(scene, p.film);
        row["seconds"] = seconds;
        row["error"] = error;
        row["error_is"] = scene.references[0].empty() ? "estimated from its own samples" : "against two references";
        // Plain Monte Carlo halves the squared error in twice the time: what stays is their product.
        row["error_seconds"] = error * seconds;
        row["differing_pixels"] = differing_pixels(p.film, painters[0].film);
        row["same_bits"] = row["differing_pixels"] == 0;
        row["compared_with"] = painters[0].name;
        add_ratio(row, painters[0].name, timings[0], timings[i], options.threads);
        print_row(row);
    }
}

}  // namespace
}  // namespace lancer::bench

int main(int argc, char** argv)
{
    using namespace lancer::bench;
    return run_program(
        argc, argv, "bench_render",
        "Draws whole pictures with each accelerator and compares their bits, their seconds and their errors.\nRatios "
        "are to the first accelerator; a picture that would take longer than some seconds is left out.",
        [](const Options& options, Report& report) {
            lancer::with_threads(options.threads, [&] {
                for (const BenchScene& scene : choose_scenes(options)) measure_scene(scene, options, report);
            });
        });
}
