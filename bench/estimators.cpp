// bench_estimators: what each estimator that can be switched gives, as error for the time, of pictures with it and
// without it in turns.
#include <algorithm>

#include "app/console.h"
#include "core/parallel.h"
#include "harness/lamps.h"
#include "harness/scenes.h"
#include "harness/stage.h"
#include "report/estimator_switches.h"
#include "report/metrics/picture_pairs.h"
#include "report/metrics/statistics.h"

namespace lancer::bench {
namespace {

// Pictures by one setting of the switches, a pair with new random numbers each round.
class Drawn {
public:
    Drawn(const SceneDescription& description, const RenderSettings& picture, uint32_t spp)
        : description_(&description), picture_(picture), spp_(spp)
    {
    }

    // CPU nanoseconds of drawing alone.
    double next_pair()
    {
        double ns = 0;
        const auto draw = [&] {
            picture_.give(&RenderSettings::seed, seed_++);
            const Stage stage(*description_, picture_);
            const double start = all_ns();
            const Film film = stage.draw(spp_);
            ns += all_ns() - start;
            return pixel_means(film);
        };
        std::vector<Color> first = draw();
        pairs_.push_back({std::move(first), draw()});
        return ns;
    }
    const std::vector<PicturePair>& pairs() const { return pairs_; }

private:
    const SceneDescription* description_;
    RenderSettings picture_;
    uint32_t spp_;
    uint64_t seed_ = 0;
    std::vector<PicturePair> pairs_;
};

// None, for the default of all, and the estimators that change the picture at all when they are switched over. What the
// picture is asked for stays.
std::vector<Estimator> that_matter(const SceneDescription& description, const RenderSettings& picture)
{
    std::vector<Estimator> matter{nullptr};
    const auto draw = [&](const RenderSettings& by) { return Stage(description, by).draw(1); };
    const Film usual = draw(picture);
    for (const Estimator e : estimators())
        if (!is_given(picture, *e) && differing_pixels(usual, draw(switched_over(picture, e))) > 0) matter.push_back(e);
    return matter;
}

void measure(const std::string& name, const SceneDescription& description, const RenderSettings& picture,
             const Options& options, Report& report)
{
    const uint32_t spp = samples_per_block;
    const std::vector<Estimator> matter = that_matter(description, picture);
    std::vector<Drawn> drawn;
    std::vector<Contestant> contestants;
    drawn.reserve(matter.size());
    for (const Estimator e : matter) {
        Drawn& d = drawn.emplace_back(description, e ? switched_over(picture, e) : picture, spp);
        const double samples = 2.0 * picture.size.width * picture.size.height * spp;
        contestants.push_back({e ? std::string(e->name) : "default", samples, {}, [&d] { return d.next_pair(); }});
    }
    const std::vector<Timing> timings = take_turns(contestants, options.repetitions, options.threads);

    std::vector<const PicturePair*> all;
    for (const Drawn& d : drawn)
        for (const PicturePair& pair : d.pairs()) all.push_back(&pair);
    const std::vector<Color> mean = mean_of(all);
    std::vector<std::vector<double>> errors;
    for (const Drawn& d : drawn) {
        std::vector<double>& of = errors.emplace_back();
        // The first pair was drawn to warm up.
        for (size_t i = 1; i < d.pairs().size(); ++i) of.push_back(error_of(d.pairs()[i], mean));
    }
    for (size_t i = 0; i < contestants.size(); ++i) {
        Json& row = report.add("estimators", joined({name, contestants[i].name}), timings[i], 1);
        row["threads"] = options.threads;
        row["mesh"] = name, row["way"] = contestants[i].name;
        row["error"] = median(errors[i]);
        if (matter[i]) row["switched"] = is_on(picture, matter[i]) ? "off" : "on";
        add_ratio(row, contestants[0].name, timings[0], timings[i], 1);
        if (i > 0) {
            std::vector<double> gains, less;
            for (size_t r = 0; r < errors[i].size(); ++r) {
                less.push_back(errors[i][r] / errors[0][r]);
                gains.push_back(less[r] * timings[i].cpu[r] / timings[0].cpu[r]);
            }
            const Interval interval = median_interval(gains);
            // How many times the error, and the error for the time, the picture has that is not by default.
            row["error_ratio"] = median(less);
            row["gain"] = median(gains), row["gain_low"] = interval.low, row["gain_high"] = interval.high;
        }
        print_row(row);
    }
}

}  // namespace
}  // namespace lancer::bench

int main(int argc, char** argv)
{
    using namespace lancer::bench;
    return run_program(
        argc, argv, "bench_estimators",
        "Draws scenes with each estimator switched over, in turns with the default, and shows the default's gain: the "
        "other's error times its time over its own.\nEstimators that a scene has no use for are left out. Names for "
        "--only: scenes, and two of 10,000 lamps: lamps, a box that all of them light, and hall, where each lights a "
        "part; lamps-unsplit and hall-unsplit are of single paths.",
        [](const Options& options, Report& report) {
            lancer::with_threads(options.threads, [&] {
                const uint32_t height = options.full ? 192 : 96;
                for (const BenchScene& scene : choose_scenes(options))
                    measure(scene.name, scene.load(), scene.options(height), options, report);
                lancer::RenderSettings picture;
                picture.give(&lancer::RenderSettings::size, {height * 4 / 3, height});
                picture.give(&lancer::RenderSettings::max_depth, 4);
                // Where all paths are single, the price of a sample is that of the estimator.
                lancer::RenderSettings unsplit = picture;
                unsplit.give(&lancer::RenderSettings::split, false);
                const auto lit = [&](const std::string& name, const auto& scene_of) {
                    if (options.wants(name)) measure(name, scene_of(10'000), picture, options, report);
                    if (options.wants(name + "-unsplit"))
                        measure(name + "-unsplit", scene_of(10'000), unsplit, options, report);
                };
                lit("lamps", box_of_lamps), lit("hall", hall_of_lamps);
            });
        });
}
