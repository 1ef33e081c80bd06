// How many rays leave closed meshes through nothing: from inside, random ones, at edges, at corners and along the axes,
// where a mesh lies and far from the origin, with every accelerator and in every way of asking it. Fails if a
// hand-written one loses a ray.
#include "support/watertight.h"

#include "app/console.h"
#include "harness/meshes.h"
#include "harness/program.h"
#include "support/displaced.h"

namespace lancer::bench {
namespace {

constexpr Vec3d far_away{148376, 1234, -223423};

struct ClosedMesh {
    std::string name;
    std::function<Mesh()> load;
};

// Singly; the other ways get a tenth.
uint64_t rays_of(Aim aim, bool full)
{
    if (!full) return 100'000;
    return aim == Aim::random ? 100'000'000 : 10'000'000;
}

class Campaign {
public:
    Campaign(const Options& options, Report& report) : options_(options), report_(report) {}

    // False if there is no room inside for rays to start.
    bool mesh(const std::string& name, const std::string& where, Mesh mesh)
    {
        Geometry g;
        g.meshes.push_back(std::move(mesh));
        const std::vector<Ball> balls = balls_inside(g, 8);
        if (balls.empty()) return false;
        const RaysFromInside rays(g.meshes[0], balls);
        for (const AccelName& a : accelerators) {
            if (!options_.wants_accel(a.name.data())) continue;
            const auto accel = make_accelerator(a.kind, g, "avx2");
            for (const Asked asked : all_asked) one(name, where, g, a, *accel, rays, asked);
        }
        return true;
    }
    // Coordinates there are multiples of 1/64: meshes of which nothing would be left are made larger before, by a power
    // of two.
    void mesh_far_away(const std::string& name, Mesh mesh)
    {
        while (!this->mesh(name, "far away", moved(mesh, far_away)))
            for (Vec3& p : mesh.positions) p *= 2;
    }

private:
    void one(const std::string& name, const std::string& where, const Geometry& g, const AccelName& a,
             const Accelerator& accel, const RaysFromInside& rays, Asked asked)
    {
        const auto triangles = static_cast<double>(g.meshes[0].triangles.size());
        const std::string way(name_of(asked));
        Json& row = report_.add("watertight", joined({name, where, std::string(a.name), way}));
        row["mesh"] = name + " " + where;
        row["accel"] = a.name;
        row["way"] = way;
        row["triangles"] = g.meshes[0].triangles.size();
        std::string line = format_text("%-44s", row["name"].get<std::string>().c_str());
        for (const Aim aim : aims) {
            uint64_t count = rays_of(aim, options_.full) / (asked == Asked::singly ? 1 : 10);
            if (a.tries_all)
                count = std::min(count, static_cast<uint64_t>(1 + (options_.full ? 4e8 : 4e6) / triangles));
            const uint64_t lost = count_misses(accel, rays, aim, asked, 0, count);
            const std::string kind(name_of(aim));
            row["misses_" + kind] = 1e6 * static_cast<double>(lost) / static_cast<double>(count);
            row["lost_" + kind] = lost;
            row["rays_" + kind] = count;
            line += format_text("  %s %llu of %.3g", kind.c_str(), static_cast<unsigned long long>(lost),
                                static_cast<double>(count));
            if (a.kind != AccelKind::embree && lost > 0) report_.fail("a hand-written accelerator lost rays");
        }
        print_result(line);
    }

    const Options& options_;
    Report& report_;
};

std::vector<ClosedMesh> candidates(const Options& options)
{
    const auto scaled = [](Vec3d s) { return make_transform({}, {30, 40, 50}, s); };
    std::vector<ClosedMesh> all;
    const auto add = [&](const std::string& name, std::function<Mesh()> load) {
        if (options.wants(name)) all.push_back({name, std::move(load)});
    };
    add("fine-sphere", [full = options.full] {
        return to_mesh(full ? *make_uv_sphere(500, 1000) : *make_uv_sphere(100, 200),
                       make_transform({}, {}, {2, 2, 2}));
    });
    add("cube", [] { return to_mesh(*make_cube()); });
    add("thin-box", [=] { return to_mesh(*make_cube(), scaled({5000, 0.5, 5000})); });
    // Its triangles differ in size, and every edge of the cube that it was is a seam of texture and normals.
    add("displaced-ball", [full = options.full] {
        const MaterialDescription m = displaced_by("waves", 0.2f);
        SceneDescription d = displaced_scene(displaceable_ball(3, m), m, edges_of(full ? 2 : 8));
        d.camera->position = {1.3, 1.4, 1.2};
        return to_mesh(divided_mesh(d, test_picture));
    });
    add("needles",
        [full = options.full] { return to_mesh(full ? *make_uv_sphere(4, 20000) : *make_uv_sphere(4, 2000)); });
    add("tiny-sphere", [=] { return to_mesh(*make_uv_sphere(100, 200), scaled({1e-6, 1e-6, 1e-6})); });
    add("huge-sphere", [=] { return to_mesh(*make_uv_sphere(100, 200), scaled({1e6, 1e6, 1e6})); });
    for (const MeshChoice& choice : choose_meshes(options))
        all.push_back({choice.name, [choice] { return to_mesh(*choice.load().meshes.at(0).data); }});
    return all;
}

}  // namespace
}  // namespace lancer::bench

int main(int argc, char** argv)
{
    using namespace lancer;
    using namespace lancer::bench;
    return run_program(
        argc, argv, "bench_watertight",
        "Count the rays that leave closed meshes through nothing: 100,000 random ones, at edges, at corners and along "
        "the axes or, with --full, 100,000,000 random and 10,000,000 of the others. Meshes that are not closed are "
        "left out. Fails if a hand-written accelerator loses a ray; Embree's are only counted.",
        [&](const Options& options, Report& report) {
            Campaign campaign(options, report);
            for (const ClosedMesh& closed : candidates(options)) {
                const Mesh mesh = closed.load();
                if (!options.full && options.only.empty() && mesh.triangles.size() > 100'000) continue;
                if (!is_closed(mesh)) {
                    print_result(closed.name + ": not closed, left out");
                    continue;
                }
                if (campaign.mesh(closed.name, "in place", mesh))
                    campaign.mesh_far_away(closed.name, mesh);
                else
                    print_result(closed.name + ": no room inside, left out");
            }
        });
}
