#include "app/bench/measure.h"

#include <algorithm>
#include <filesystem>

#include "app/bench/rounds.h"
#include "app/bench/schedule.h"
#include "app/console.h"
#include "core/clock.h"
#include "core/parallel.h"

namespace lancer {
namespace {

// Rays of a round, for each thread: short rounds are many, and what disturbs one method mostly disturbs its neighbours.
constexpr size_t usual_slice = 4096;
// Of the rays of each kind; fewer where there is no time to find many.
size_t slices_wanted(double seconds) { return seconds < 10 ? 4 : 16; }
// Triangles times rays that a list is asked to settle disputes, for each kind.
double most_tests(double seconds) { return 5e5 * seconds; }

std::string hash_text(uint64_t bits) { return format_text("%016llx", static_cast<unsigned long long>(bits)); }

// What one thread can ask of all triangles in about 0.2 s, where some method does that.
size_t slice_of(const std::vector<BenchMethod>& methods, const Geometry& g)
{
    constexpr double tests = 1e7;
    if (std::none_of(methods.begin(), methods.end(), [](const auto& m) { return tries_all(m.name()); }))
        return usual_slice;
    const double rays = tests / static_cast<double>(drawn_triangles(g));
    return std::clamp<size_t>(static_cast<size_t>(rays), 16, usual_slice);
}

struct WrongAnswers {
    std::string rays;
    size_t count = 0;                         // of rays that were asked
    std::vector<double> wrong[2], missed[2];  // singly and in batches, of each method, per million
};

// Both ways of all methods, on up to `most` rays.
WrongAnswers check_answers(const RaySet& all, const std::vector<BenchMethod>& methods, const Geometry& g, size_t most,
                           double tests)
{
    RaySet set = all;
    set.rays.resize(std::min(most, set.rays.size()));
    std::vector<Answers> answers(2 * methods.size());
    parallel_for(answers.size(), [&](size_t i) {
        const BenchMethod& m = methods[i / 2];
        answers[i] = answer(i % 2 ? m.batch() : m.single(), set, g);
    });
    const Disagreements d = count_disagreements(g, set, answers, tests);
    WrongAnswers found{std::string(set.kind), set.rays.size(), {}, {}};
    for (size_t i = 0; i < answers.size(); ++i) {
        found.wrong[i % 2].push_back(d.per_million[i] - d.missed_per_million[i]);
        found.missed[i % 2].push_back(d.missed_per_million[i]);
    }
    return found;
}

class BenchMeasurement {
public:
    BenchMeasurement(const BenchScene& scene, const BenchWork& work, BenchRun& run)
        : scene_(scene), work_(work), run_(run), threads_(scene.threads())
    {
        for (const std::string& name : work.options.methods) methods_.emplace_back(name, scene.bare(), scene.isa());
    }

    void execute()
    {
        find_rays();
        if (!work_.is_stopped()) build();
        if (!work_.is_stopped()) check();
        if (!work_.is_stopped()) measure();
        if (!work_.is_stopped() && run_.figures.empty())
            throw Error(ErrorKind::failed, {},
                        "--time: it was over before anything was measured; finding rays and building took " +
                            format_text("%.3g s", 1e-9 * (wall_ns() - begin_)));
    }

private:
    double seconds() const { return work_.options.seconds; }

    void find_rays()
    {
        const std::vector<std::string_view> kinds(work_.options.rays.begin(), work_.options.rays.end());
        const size_t slices = slices_wanted(seconds());
        sets_ = scene_.rays(slices * usual_slice, kinds);
        for (RaySet& set : sets_) deal(set);
        if (sets_.empty())
            throw Error(ErrorKind::invalid_input, {work_.options.picture.scene.file},
                        "the view has none of these rays");
        run_.rays.clear();
        for (const RaySet& set : sets_) run_.rays.emplace_back(set.kind, hash_text(hash_of(set)));
        work_.note(format_text("rays of %zu kinds after %.1f s", sets_.size(), 1e-9 * (wall_ns() - begin_)));
    }
    void build()
    {
        for (const unsigned threads : thread_counts())
            builds_.push_back(std::make_unique<BuildRounds>(methods_, threads));
        const double begin = wall_ns();
        builds_.back()->step();
        built_s_ = 1e-9 * (wall_ns() - begin);
        for (const BenchMethod& m : methods_) bytes_.push_back(m.bytes());
        work_.note(format_text("built in %.1f s", built_s_));
    }
    void check()
    {
        const size_t slice = slice_of(methods_, scene_.bare());
        const size_t most = slice < usual_slice ? 4 * slice : SIZE_MAX;
        for (const RaySet& set : sets_) {
            if (work_.is_stopped() || wall_ns() > work_.end) return;
            answers_.push_back(check_answers(set, methods_, scene_.bare(), most, most_tests(seconds())));
        }
    }
    void measure()
    {
        const size_t slice = slice_of(methods_, scene_.bare());
        const bool both = threads_ > 1;
        std::vector<BenchPart> parts;
        for (const unsigned threads : thread_counts()) {
            RayRounds& rays = *rays_.emplace_back(std::make_unique<RayRounds>(sets_, methods_, threads, slice));
            // With more threads a round takes the longer where others have CPUs as well.
            parts.push_back({"rays",
                             !both          ? 0.7
                             : threads == 1 ? 0.3
                                            : 0.4,
                             [&rays, this] {
                                 rays.step();
                                 tell_progress(rays);
                             }});
        }
        const auto picture = std::make_unique<BenchPicture>(scene_, methods_, work_.options.error);
        for (const unsigned threads : thread_counts()) {
            PictureRounds& pictures = *pictures_.emplace_back(std::make_unique<PictureRounds>(*picture, threads));
            parts.push_back({"picture", 0.075, [&pictures] { pictures.step(); }});
        }
        for (const auto& builds : builds_) {
            const bool is_first = builds == builds_.back();
            // On one thread it takes the longer, the more threads there were.
            parts.push_back({"build", 0.075, [&b = *builds] { b.step(); }, built_s_ * (is_first ? 1 : threads_)});
        }
        work_.note(format_text("measuring after %.1f s", 1e-9 * (wall_ns() - begin_)));
        run_parts(
            parts, 1e-9 * work_.end, [] { return 1e-9 * wall_ns(); }, work_.is_stopped);
        collect(*picture);
    }
    // Now and then, of the first part.
    void tell_progress(const RayRounds& rays)
    {
        constexpr double interval = 10e9;
        const double now = wall_ns();
        if (&rays != rays_.front().get() || rays.rounds() == 0 || now < told_ + interval) return;
        told_ = now;
        work_.note(format_text("round %zu after %.0f of %.0f s", rays.rounds(), 1e-9 * (now - begin_), seconds()));
    }
    void collect(const BenchPicture& picture)
    {
        const auto add = [&](const BenchGroup& group, const auto& tell) {
            for (BenchFigure& f : figures_of(group, run_.methods, run_.baseline)) {
                const auto m = static_cast<size_t>(std::find(run_.methods.begin(), run_.methods.end(), f.accel) -
                                                   run_.methods.begin());
                tell(f, m);
                run_.figures.push_back(std::move(f));
            }
        };
        for (const auto& rays : rays_)
            for (const BenchGroup& group : rays->groups())
                add(group, [&](BenchFigure& f, size_t m) { tell_answers(f, m); });
        for (const auto& builds : builds_)
            add(builds->group(), [&](BenchFigure& f, size_t m) {
                f.counters = {{"bytes", double(bytes_[m])}, {"total_bytes", double(bytes_[m] + run_.mesh_bytes)}};
            });
        for (const auto& pictures : pictures_)
            add(pictures->group(), [&](BenchFigure& f, size_t m) {
                f.counters = {{"spp", picture.spp}, {"differing_pixels", double(pictures->differing(m))}};
            });
    }
    void tell_answers(BenchFigure& f, size_t method) const
    {
        const size_t way = f.way == "batch";
        for (const WrongAnswers& a : answers_)
            if (a.rays == f.rays)
                f.counters = {{"wrong_per_million", a.wrong[way][method]},
                              {"missed_per_million", a.missed[way][method]},
                              {"ray_count", double(a.count)}};
    }
    std::vector<unsigned> thread_counts() const { return threads_ == 1 ? std::vector{1u} : std::vector{1u, threads_}; }

    const BenchScene& scene_;
    const BenchWork& work_;
    BenchRun& run_;
    const double begin_ = wall_ns();
    unsigned threads_;
    std::vector<BenchMethod> methods_;
    std::vector<RaySet> sets_;
    std::vector<uint64_t> bytes_;  // of each method
    double built_s_ = 0, told_ = -1e18;
    std::vector<WrongAnswers> answers_;
    std::vector<std::unique_ptr<RayRounds>> rays_;
    std::vector<std::unique_ptr<BuildRounds>> builds_;
    std::vector<std::unique_ptr<PictureRounds>> pictures_;
};

uint64_t bytes_of(const Geometry& g)
{
    uint64_t bytes = g.instances.size() * sizeof(Instance);
    for (const Mesh& m : g.meshes)
        bytes += m.positions.size() * sizeof m.positions[0] + m.triangles.size() * sizeof m.triangles[0];
    return bytes;
}

}  // namespace

BenchRun describe_bench(const BenchScene& scene, const BenchOptions& options)
{
    BenchRun run;
    run.file = options.picture.scene.file, run.mesh = std::filesystem::path(run.file).stem();
    run.mesh_hash = hash_text(scene.hash());
    run.triangles = drawn_triangles(scene.bare()), run.mesh_bytes = bytes_of(scene.bare());
    run.baseline = bench_baseline, run.methods = options.methods;
    for (const std::string& kind : options.rays) run.rays.emplace_back(kind, "");
    run.picture_error = options.error;
    return run;
}

void measure_bench(const BenchScene& scene, const BenchWork& work, BenchRun& run)
{
    BenchMeasurement(scene, work, run).execute();
}

}  // namespace lancer
