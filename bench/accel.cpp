// bench_accel: every accelerator of the product beside bare Embree, on the same rays of real renders: building, speed
// for each kind of ray, singly and in batches, and how often they are wrong.
#include <algorithm>
#include <optional>

#include "app/bench/agreement.h"
#include "app/bench/batches.h"
#include "app/console.h"
#include "core/parallel.h"
#include "geometry/bvh2/bvh2.h"
#include "geometry/bvh8/bvh8.h"
#include "geometry/refine_all.h"
#include "harness/bare_tree.h"
#include "harness/meshes.h"
#include "harness/stage.h"
#include "report/metrics/statistics.h"

namespace lancer::bench {
namespace {

constexpr double most_run_ns = 3e7;  // what is slower gets fewer rays

const BareMode product_mode{};

std::vector<BareMode> bare_modes(bool full)
{
    std::vector<BareMode> modes;
    std::vector<std::string> isas{"avx2"};
    if (widest_isa() != "avx2") isas.push_back(widest_isa());
    for (const std::string& isa : isas)
        for (const bool robust : {true, false})
            for (const bool high : {true, false})
                if (full || high || isa == "avx2") modes.push_back({robust, high, isa});
    return modes;
}

// Those that build differently: not by instruction set, and only fast scenes get spatial splits of high quality.
std::vector<BareMode> built_modes(bool full)
{
    if (full) return bare_modes(full);
    return {product_mode, {.robust = true, .high = false}, {.robust = false, .high = true}};
}

// Only meshes that are drawn as they are: what stands around them is not the tree's.
bool is_plain(const Geometry& g)
{
    return g.instances.empty() && g.spheres.empty() && g.planes.empty() && !g.alpha_test.passes_through;
}

// All that is built over one mesh.
struct Subjects {
    std::optional<BareTree<Bvh2>> bvh2;
    std::optional<BareTree<Bvh8>> bvh8;
    std::vector<std::pair<std::string, std::unique_ptr<Accelerator>>> accels;
    std::vector<std::pair<BareMode, std::unique_ptr<BareEmbree>>> bare;

    Subjects(const Geometry& g, const Options& options)
    {
        if (is_plain(g) && options.wants_accel("bvh2")) bvh2.emplace(g);
        if (is_plain(g) && options.wants_accel("bvh8")) bvh8.emplace(g);
        for (const AccelName& a : accelerators)
            if (options.wants_accel(std::string(a.name)))
                accels.emplace_back(a.name, make_accelerator(a.kind, g, product_mode.isa));
        for (const BareMode& mode : bare_modes(options.full))
            bare.emplace_back(mode, std::make_unique<BareEmbree>(g, mode));
    }
};

template <class Tree>
RayMethod bare_tree_method(const char* name, const BareTree<Tree>& tree)
{
    return {name, "single",
            [&tree](auto rays, auto hits, Coherence) {
                for (size_t i = 0; i < rays.size(); ++i) hits[i] = tree.closest(rays[i]);
            },
            [&tree](auto rays, auto out, Coherence) {
                for (size_t i = 0; i < rays.size(); ++i) out[i] = tree.any(rays[i]);
            },
            false};
}

std::vector<RayMethod> methods_of(const Subjects& s, const Geometry& g)
{
    std::vector<RayMethod> all;
    for (const auto& [mode, owner] : s.bare) {
        const BareEmbree* bare = owner.get();
        const std::string name = name_of(mode);
        for (const Way way : {Way::single, Way::packet8, Way::packet16})
            if (way != Way::packet16 || has_native_16(mode.isa)) all.push_back(direct_method(name, *bare, way));
        if (name != name_of(product_mode)) continue;
        // What an accelerator of ours gives back, from Embree called directly.
        all.push_back({name + "+refine",
                       "single",
                       [bare, &g](auto rays, auto hits, Coherence) {
                           for (size_t i = 0; i < rays.size(); ++i)
                               if ((hits[i] = bare->closest(rays[i]))) hits[i] = refine(g, rays[i], hits[i]);
                       },
                       {}});
    }
    if (s.bvh2) all.push_back(bare_tree_method("bvh2-tree", *s.bvh2));
    if (s.bvh8) all.push_back(bare_tree_method("bvh8-tree", *s.bvh8));
    for (const auto& [name, accel] : s.accels) {
        all.push_back(single_method(name, *accel));
        all.push_back(batch_method(name, *accel));
    }
    return all;
}

// The rays that a method gets: all, or of the slow ones as many as its time allows, from all over the set.
RaySet fitted(const RayMethod& e, const RaySet& set, const Geometry& g)
{
    const auto thinned = [&](size_t count) {
        RaySet some{set.kind, set.occlusion, set.coherence, {}};
        for (size_t i = 0; i < count; ++i) some.rays.push_back(set.rays[i * set.rays.size() / count]);
        return some;
    };
    const RaySet probe = thinned(std::min<size_t>(64, set.rays.size()));
    answer(e, probe, g);
    const double start = thread_ns();
    answer(e, probe, g);
    const double each = (thread_ns() - start) / static_cast<double>(probe.rays.size());
    // The probe is too short to tell more than whether the method is slow by far.
    const auto most = static_cast<size_t>(std::max(16.0, most_run_ns / each));
    return 2 * most >= set.rays.size() ? set : thinned(most);
}

void measure_kind(const std::string& mesh, const RaySet& set, const std::vector<RayMethod>& methods, const Geometry& g,
                  const Options& options, Report& report)
{
    std::vector<const RayMethod*> taken;
    std::vector<RaySet> given;
    std::vector<Answers> answers;  // of those who got all rays
    std::vector<size_t> thorough;
    for (const RayMethod& e : methods) {
        if (set.occlusion && !e.any) continue;
        given.push_back(fitted(e, set, g));
        if (given.back().rays.size() == set.rays.size()) {
            thorough.push_back(taken.size());
            answers.push_back(answer(e, set, g));
        }
        taken.push_back(&e);
    }
    const Disagreements wrong = count_disagreements(g, set, answers);

    std::vector<Hit> hits(set.rays.size());
    std::vector<uint8_t> occluded(set.rays.size());
    std::vector<Contestant> contestants;
    for (size_t i = 0; i < taken.size(); ++i) {
        const std::span<const Ray> rays = given[i].rays;
        contestants.push_back({taken[i]->name, static_cast<double>(rays.size()), [&, i, rays] {
                                   if (set.occlusion)
                                       taken[i]->any(rays, std::span(occluded).first(rays.size()), set.coherence);
                                   else
                                       taken[i]->closest(rays, std::span(hits).first(rays.size()), set.coherence);
                               }});
    }
    const std::vector<Timing> timings = take_turns(contestants, options.repetitions, 1);
    for (size_t i = 0; i < taken.size(); ++i) {
        const RayMethod& e = *taken[i];
        const std::string kind(set.kind);
        Json& row = report.add("accel", joined({mesh, e.name, kind, e.way}), timings[i], 1);
        row["mesh"] = mesh, row["accel"] = e.name, row["rays"] = kind, row["way"] = e.way;
        row["ray_count"] = given[i].rays.size();
        add_ratio(row, joined({name_of(product_mode), "single"}), timings[0], timings[i], 1);
        const auto at = std::find(thorough.begin(), thorough.end(), i);
        if (at != thorough.end()) {
            row["disagreements"] = wrong.per_million[static_cast<size_t>(at - thorough.begin())];
            row["disputed"] = wrong.disputed, row["disputed_asked"] = wrong.asked;
        }
        print_row(row);
    }
}

uint64_t triangles_of(const Geometry& g)
{
    uint64_t count = 0;
    for (const Mesh& m : g.meshes) count += m.triangles.size();
    return count;
}

// What building gave besides seconds.
struct Built {
    uint64_t bytes;
    double sah_cost;  // 0: not told
};

void measure_builds(const std::string& mesh, const Geometry& g, unsigned threads, const Options& options,
                    Report& report)
{
    const auto triangles = static_cast<double>(triangles_of(g));
    std::vector<Contestant> contestants;
    std::vector<Built> built;
    const auto add = [&](const std::string& name, const std::function<Built()>& build) {
        const size_t i = built.size();
        built.push_back({});
        contestants.push_back({name, 1, [&built, i, build] { built[i] = build(); }});
    };
    for (const BareMode& mode : built_modes(options.full))
        add(name_of(mode), [&g, mode] { return Built{BareEmbree(g, mode).bytes(), 0}; });
    for (const AccelName& a : accelerators) {
        if (a.kind == AccelKind::list || !options.wants_accel(std::string(a.name)))
            continue;  // it has nothing to build
        add(std::string(a.name), [&g, kind = a.kind] {
            const AccelStats stats = make_accelerator(kind, g, product_mode.isa)->stats();
            return Built{stats.bytes, stats.sah_cost};
        });
    }
    std::vector<Timing> timings;
    with_threads(threads, [&] { timings = take_turns(contestants, options.repetitions, threads); });
    for (size_t i = 0; i < contestants.size(); ++i) {
        const Timing& t = timings[i];
        Json& row =
            report.add("build", joined({mesh, contestants[i].name, "threads" + std::to_string(threads)}), t, threads);
        row["mesh"] = mesh, row["accel"] = contestants[i].name;
        row["triangles"] = triangles_of(g);
        row["build_seconds"] = 1e-9 * median(counted(t, threads));
        row["triangles_per_second"] = 1e9 * triangles / median(counted(t, threads));
        row["bytes_per_triangle"] = static_cast<double>(built[i].bytes) / triangles;
        if (built[i].sah_cost > 0) row["sah_cost"] = built[i].sah_cost;
        add_ratio(row, contestants[0].name, timings[0], t, threads);
        print_row(row);
    }
}

// What the class around Embree costs, against calling Embree directly for the same answers, and its largest part.
void measure_seam(const std::string& mesh, const RaySet& set, const Geometry& g, const Options& options, Report& report)
{
    const auto accel = make_accelerator(AccelKind::embree, g, product_mode.isa);
    const BareEmbree bare(g, product_mode);
    const std::span<const Ray> rays = set.rays;
    std::vector<Hit> hits(rays.size()), found(rays.size());
    std::vector<uint8_t> occluded(rays.size());
    const auto count = static_cast<double>(rays.size());
    std::vector<Contestant> contestants;
    if (set.occlusion) {
        contestants = {{"direct", count,
                        [&] {
                            in_batches(rays, std::span(occluded),
                                       [&](auto some, auto out) { bare.any(some, out, Way::packet8, set.coherence); });
                        }},
                       {"class", count, [&] {
                            in_batches(rays, std::span(occluded), [&](auto some, auto out) { accel->any(some, out); });
                        }}};
    } else {
        bare.closest(rays, found, Way::packet8, set.coherence);
        contestants = {{"direct", count,
                        [&] {
                            in_batches(rays, std::span(hits), [&](auto some, auto out) {
                                bare.closest(some, out, Way::packet8, set.coherence);
                                refine_all(g, some, out);
                            });
                        }},
                       {"class", count,
                        [&] {
                            in_batches(rays, std::span(hits),
                                       [&](auto some, auto out) { accel->closest(some, out, set.coherence); });
                        }},
                       {"refine", count, [&] {
                            hits = found;
                            in_batches(rays, std::span(hits), [&](auto some, auto out) { refine_all(g, some, out); });
                            keep(hits);
                        }}};
    }
    const std::vector<Timing> timings = take_turns(contestants, std::max(9u, options.repetitions), 1);
    for (size_t i = 0; i < contestants.size(); ++i) {
        const std::string kind(set.kind);
        Json& row = report.add("seam", joined({mesh, contestants[i].name, kind, "batch"}), timings[i], 1);
        row["mesh"] = mesh, row["accel"] = contestants[i].name, row["rays"] = kind, row["way"] = "batch";
        add_ratio(row, "direct", timings[0], timings[i], 1);
        if (contestants[i].name == "class")
            row["extra_ns"] = median(timings[i].cpu) - median(timings[0].cpu);  // of each ray
        print_row(row);
    }
}

void measure_mesh(const MeshChoice& choice, const Options& options, Report& report)
{
    RenderSettings picture;
    picture.give(&RenderSettings::size, {640, 480});
    const Stage stage(choice.load(), picture);
    const Geometry& g = stage.scene.geometry;
    measure_builds(choice.name, g, 1, options, report);
    const unsigned most = std::max(options.threads, available_threads());
    if (most > 1) measure_builds(choice.name, g, most, options, report);

    const Subjects subjects(g, options);
    const std::vector<RayMethod> methods = methods_of(subjects, g);
    for (const RaySet& set : find_rays(stage.source(), options.full ? 500'000 : 50'000, suite_kinds)) {
        measure_kind(choice.name, set, methods, g, options, report);
        measure_seam(choice.name, set, g, options, report);
    }
}

}  // namespace
}  // namespace lancer::bench

int main(int argc, char** argv)
{
    using namespace lancer::bench;
    return run_program(
        argc, argv, "bench_accel",
        "Times every accelerator beside bare Embree on the rays of real renders, and says how often each "
        "is wrong.\nSpeeds are those of one thread; ratios are to Embree robust, high, avx2, singly.",
        [](const Options& options, Report& report) {
            for (const MeshChoice& mesh : choose_meshes(options)) measure_mesh(mesh, options, report);
        });
}
