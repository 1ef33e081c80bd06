// Whether accelerators find what is there: every kind of ray against the list of triangles in double, and many more
// against a tree in double that is held to the list. Fails if a hand-written accelerator's answer is another than the
// reference's and neither a tie nor a matter of float's rounding at an edge explains it.
#include "support/agreement.h"

#include <filesystem>

#include "app/console.h"
#include "core/parallel.h"
#include "geometry/list/list.h"
#include "harness/meshes.h"
#include "harness/program.h"
#include "harness/reference.h"
#include "support/meshes.h"

namespace lancer::bench {
namespace {

constexpr size_t chunk = 1024;

// Primary rays as a renderer asks for them, the others as they come.
enum class Asked { singly, in_batches };

struct Answers {
    std::vector<Hit> hits;
    std::vector<uint8_t> occluded;
};

Answers ask(const Accelerator& accel, std::span<const Ray> rays, RayKind kind, Asked asked)
{
    Answers a{std::vector<Hit>(rays.size()), std::vector<uint8_t>(rays.size())};
    parallel_for((rays.size() + chunk - 1) / chunk, [&](size_t c) {
        const size_t first = c * chunk, n = std::min(chunk, rays.size() - first);
        if (asked == Asked::in_batches) {
            const auto coherence = kind == RayKind::primary ? Coherence::coherent : Coherence::incoherent;
            accel.closest(rays.subspan(first, n), std::span(a.hits).subspan(first, n), coherence);
            accel.any(rays.subspan(first, n), std::span(a.occluded).subspan(first, n));
            return;
        }
        for (size_t i = first; i < first + n; ++i) {
            a.hits[i] = accel.closest(rays[i]);
            a.occluded[i] = accel.any(rays[i]);
        }
    });
    return a;
}

struct Counts {
    Agreement closest, any;
};
Counts compare(const Geometry& g, std::span<const Ray> rays, std::span<const uint32_t> reference, const Answers& found)
{
    Counts counts;
    for (size_t i = 0; i < found.hits.size(); ++i) {
        const Hit expected = hit_of(g, rays[i], reference[i]);
        counts.closest.count(g, rays[i], i, expected, found.hits[i]);
        counts.any.count_any(g, rays[i], i, expected, found.occluded[i] != 0, found.hits[i]);
    }
    return counts;
}

class Study {
public:
    Study(const Options& options, Report& report) : options_(options), report_(report) {}

    void mesh(const std::string& name, const Geometry& g)
    {
        const auto triangles = static_cast<double>(g.meshes[0].triangles.size());
        const RaysOfKinds generator(g);
        Reference reference(g, options_.cache);
        std::vector<std::unique_ptr<Accelerator>> accels;
        for (const AccelName& a : accelerators)
            accels.push_back(options_.wants_accel(a.name.data()) ? make_accelerator(a.kind, g, "avx2") : nullptr);
        for (const RayKind kind : ray_kinds) {
            std::vector<Ray> rays(options_.full ? 1'000'000 : 20'000);
            parallel_for(rays.size(), [&](size_t i) { rays[i] = generator.ray(kind, i); });
            const std::vector<uint32_t> expected = reference.answers(rays);
            // What looks at every triangle is asked as much as takes some seconds; the list in full as often as it
            // takes.
            const auto affordable = static_cast<size_t>(1 + (options_.full ? 2e9 : 2e7) / triangles);
            for (size_t i = 0; i < accelerators.size(); ++i) {
                if (!accels[i]) continue;
                size_t count = rays.size();
                if (accelerators[i].tries_all) count = std::min(count, affordable);
                if (accelerators[i].kind == AccelKind::list && options_.full)
                    count = std::min<size_t>(rays.size(), 20'000);
                for (const Asked asked : {Asked::singly, Asked::in_batches})
                    compare_one(name, g, accelerators[i], *accels[i], kind, asked, std::span(rays).first(count),
                                expected);
            }
        }
    }

private:
    void compare_one(const std::string& mesh, const Geometry& g, const AccelName& a, const Accelerator& accel,
                     RayKind kind, Asked asked, std::span<const Ray> rays, std::span<const uint32_t> expected)
    {
        if (a.kind == AccelKind::list && asked == Asked::in_batches) return;  // which it traces singly
        const Counts counts = compare(g, rays, expected, ask(accel, rays, kind, asked));
        const std::string way = asked == Asked::singly ? "single" : "batch";
        Json& row = report_.add("agreement", joined({mesh, std::string(a.name), std::string(name_of(kind)), way}));
        row["mesh"] = mesh;
        row["accel"] = a.name;
        row["rays"] = name_of(kind);
        row["way"] = way;
        row["triangles"] = g.meshes[0].triangles.size();
        row["rays_traced"] = rays.size();
        row["same"] = counts.closest.same;
        row["ties"] = counts.closest.ties;
        row["explained"] = counts.closest.explained;
        row["wrong"] = counts.closest.wrong;
        row["wrong_any"] = counts.any.wrong;
        const uint64_t wrong = counts.closest.wrong + counts.any.wrong;
        row["disagreements"] = 1e6 * static_cast<double>(wrong) / static_cast<double>(rays.size());
        if (wrong) row["first_wrong"] = std::min(counts.closest.first_wrong, counts.any.first_wrong);
        print_result(format_text(
            "%-44s %8zu rays  ties %6llu  explained %6llu  wrong %4llu  any %4llu",
            row["name"].get<std::string>().c_str(), rays.size(), static_cast<unsigned long long>(counts.closest.ties),
            static_cast<unsigned long long>(counts.closest.explained),
            static_cast<unsigned long long>(counts.closest.wrong), static_cast<unsigned long long>(counts.any.wrong)));
        // Of the list not even ties: the reference is to be the list.
        const bool same = counts.closest.same == rays.size() && counts.any.same == rays.size();
        if ((a.kind == AccelKind::list && !same) || (a.kind != AccelKind::embree && wrong > 0))
            report_.fail("a hand-written accelerator gave wrong answers");
    }

    const Options& options_;
    Report& report_;
};

}  // namespace
}  // namespace lancer::bench

int main(int argc, char** argv)
{
    using namespace lancer;
    using namespace lancer::bench;
    return run_program(
        argc, argv, "bench_agreement",
        "Compare the answers of every accelerator with a reference in double: on each mesh rays of five kinds, 20,000 "
        "of each or, with --full, 1,000,000, and 20,000 with the list of triangles. The reference's answers are "
        "kept in the cache folder. Fails if a hand-written accelerator gives a wrong answer; Embree's are only "
        "counted.",
        [&](const Options& options, Report& report) {
            Study study(options, report);
            for (const MeshChoice& choice : choose_meshes(options)) {
                Geometry g;
                g.meshes.push_back(to_mesh(*choice.load().meshes.at(0).data));
                // Reading and building alone take long: left for --full, or for who asks by name.
                if (!options.full && options.only.empty() && g.meshes[0].triangles.size() > 500'000) continue;
                study.mesh(choice.name, g);
            }
        });
}
