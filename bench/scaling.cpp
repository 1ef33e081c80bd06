// bench_scaling: how building, memory and speed go with the number of triangles, of lights and of instances, and the
// exponents of the laws that they follow.
#include <cmath>
#include <map>

#include "app/bench/batches.h"
#include "app/bench/rays.h"
#include "app/console.h"
#include "core/parallel.h"
#include "geometry/embree/bare_embree.h"
#include "harness/generate.h"
#include "harness/lamps.h"
#include "harness/meshes.h"
#include "harness/stage.h"
#include "report/metrics/statistics.h"
#include "support/random.h"
#include "support/scenes/scenes.h"

namespace lancer::bench {
namespace {

constexpr uint64_t most_by_loop = 1000;  // triangles: what tries all of them is not asked about more

// Of one accelerator and one kind of ray: what the law is fitted to.
struct Series {
    std::vector<double> sizes, values;
};
using AllSeries = std::map<std::vector<std::string>, Series>;  // family's parts: mesh, accel, what

void add_point(AllSeries& all, const std::vector<std::string>& what, double size, double value)
{
    all[what].sizes.push_back(size), all[what].values.push_back(value);
}

void report_exponents(const AllSeries& all, const std::string& of, double from, Report& report)
{
    for (const auto& [what, series] : all) {
        std::vector<double> x, y;
        for (size_t i = 0; i < series.sizes.size(); ++i)
            if (series.sizes[i] >= from) x.push_back(series.sizes[i]), y.push_back(series.values[i]);
        if (x.size() < 3) continue;
        const PowerLaw law = fit_power_law(x, y);
        Json& row = report.add("scaling", joined({what[0], what[1], what[2], "exponent"}));
        row["mesh"] = what[0], row["accel"] = what[1], row["what"] = what[2], row["of"] = of;
        row["from"] = x.front(), row["to"] = x.back(), row["points"] = x.size();
        row["exponent"] = law.exponent;
        row["exponent_low"] = law.exponent_interval.low, row["exponent_high"] = law.exponent_interval.high;
        print_row(row);
    }
}

// Every accelerator on one geometry: builds it, then traces each kind of ray in batches and singly.
class Sizes {
public:
    Sizes(const Options& options, Report& report) : options_(options), report_(report) {}

    // size: of what grows; per: what bytes are counted by.
    void measure(const std::string& name, double size, uint64_t triangles, const Stage& stage)
    {
        const Geometry& g = stage.scene.geometry;
        std::vector<std::pair<std::string, std::unique_ptr<Accelerator>>> accels;
        for (const AccelName& a : accelerators) {
            const std::string accel(a.name);
            if (!options_.wants_accel(accel) || (a.tries_all && triangles > most_by_loop)) continue;
            const double start = all_ns();
            accels.emplace_back(accel, make_accelerator(a.kind, g, "avx2"));
            built(name, size, triangles, accel, 1e-9 * (all_ns() - start), accels.back().second->stats());
        }
        for (const RaySet& set : find_rays(stage.source(), options_.full ? 100'000 : 20'000, suite_kinds))
            trace(name, size, set, accels);
    }
    void finish(const std::string& of, double from) const { report_exponents(series_, of, from, report_); }

private:
    void built(const std::string& name, double size, uint64_t triangles, const std::string& accel, double cpu_seconds,
               const AccelStats& stats)
    {
        if (stats.bytes == 0) return;
        Json& row = report_.add("scaling", joined({name, accel, "build", format_text("%.0f", size)}));
        row["mesh"] = name, row["accel"] = accel, row["what"] = "build", row["size"] = size;
        row["triangles"] = triangles;
        row["build_seconds"] = cpu_seconds;  // of CPU, of all threads
        row["bytes"] = stats.bytes;
        row["bytes_per_triangle"] = static_cast<double>(stats.bytes) / static_cast<double>(triangles);
        print_row(row);
        add_point(series_, {name, accel, "build"}, size, cpu_seconds);
    }
    void trace(const std::string& name, double size, const RaySet& set,
               const std::vector<std::pair<std::string, std::unique_ptr<Accelerator>>>& accels)
    {
        std::vector<Hit> hits(set.rays.size());
        std::vector<uint8_t> occluded(set.rays.size());
        std::vector<Contestant> contestants;
        for (const auto& [accel, owner] : accels) {
            const Accelerator* a = owner.get();
            contestants.push_back(
                {accel, static_cast<double>(set.rays.size()), [&, a] {
                     const std::span<const Ray> rays = set.rays;
                     if (set.occlusion)
                         in_batches(rays, std::span(occluded), [&](auto some, auto out) { a->any(some, out); });
                     else
                         in_batches(rays, std::span(hits),
                                    [&](auto some, auto out) { a->closest(some, out, set.coherence); });
                 }});
        }
        const std::vector<Timing> timings = take_turns(contestants, options_.repetitions, 1);
        for (size_t i = 0; i < contestants.size(); ++i) {
            const std::string kind(set.kind), &accel = contestants[i].name;
            Json& row = report_.add("scaling", joined({name, accel, kind, format_text("%.0f", size)}), timings[i], 1);
            row["mesh"] = name, row["accel"] = accel, row["rays"] = kind, row["way"] = "single", row["what"] = kind;
            row["size"] = size;
            add_ratio(row, contestants[0].name, timings[0], timings[i], 1);
            print_row(row);
            add_point(series_, {name, accel, kind}, size, row["items_per_second"].get<double>());
        }
    }

    const Options& options_;
    Report& report_;
    AllSeries series_;
};

RenderSettings small_picture()
{
    RenderSettings o;
    o.give(&RenderSettings::size, {320, 240});
    return o;
}

void scale_triangles(const Options& options, Report& report)
{
    Sizes sizes(options, report);
    const double most = options.full ? 1e7 : 1e6;
    if (options.wants("sphere"))
        for (double n = 1e3; n <= most * 1.01; n *= options.full ? std::sqrt(10) : 10) {
            const auto mesh = make_displaced_sphere(static_cast<uint64_t>(n));
            const auto triangles = mesh->triangles.size();
            sizes.measure("sphere", static_cast<double>(triangles), triangles,
                          Stage(describe_mesh(*mesh), small_picture()));
        }
    Options only_real = options;
    only_real.only = {"armadillo"};
    for (const MeshChoice& real : choose_meshes(only_real)) {
        if (!options.wants("subdivided-" + real.name)) continue;
        const SceneDescription whole = real.load();
        for (unsigned level = 0;; ++level) {
            const auto mesh = subdivide(*whole.meshes.at(0).data, level);
            const auto triangles = mesh->triangles.size();
            if (static_cast<double>(triangles) > 1.5 * most) break;
            sizes.measure("subdivided-" + real.name, static_cast<double>(triangles), triangles,
                          Stage(describe_mesh(*mesh, whole.camera), small_picture()));
        }
    }
    sizes.finish("triangles", options.full ? 9e4 : 0);
}

void scale_lights(const Options& options, Report& report)
{
    if (!options.wants("lights")) return;
    AllSeries series;
    for (uint32_t lights = 1; lights <= 10'000; lights *= 10) {
        RenderSettings picture = small_picture();
        picture.give(&RenderSettings::size, {160, 120});
        picture.give(&RenderSettings::max_depth, 4);
        const Stage stage(box_of_lamps(lights), picture);
        const uint32_t spp = 4;
        const double samples = double(stage.settings.size.width) * stage.settings.size.height * spp;
        const Contestant draw{"embree", samples, [&] {
                                  Film film = stage.film();
                                  stage.renderer.pass(stage.camera, film, stage.tiles(), {0, spp});
                              }};
        const std::vector<Timing> timings = take_turns({draw}, options.repetitions, options.threads);
        Json& row = report.add("scaling", joined({"lights", "embree", "render", std::to_string(lights)}), timings[0],
                               options.threads);
        row["mesh"] = "lights", row["accel"] = "embree", row["what"] = "render", row["size"] = lights;
        row["ms_per_sample"] = 1e3 / row["items_per_second"].get<double>();
        print_row(row);
        add_point(series, {"lights", "embree", "render"}, lights, row["items_per_second"].get<double>());
    }
    report_exponents(series, "lights", 0, report);
}

// So many balls of 400 triangles, in a cube that has room for all of them.
SceneDescription instances_of(uint32_t count)
{
    SceneDescription d = describe_mesh(*make_displaced_sphere(400));
    d.meshes[0].name = "ball";
    Random random(7);
    const double size = 0.5 / std::cbrt(count);
    for (uint32_t i = 0; i < count; ++i) {
        InstanceDescription& instance = d.instances.emplace_back();
        instance.mesh = "ball";
        instance.transform.translate = random.point(-1, 1);
        instance.transform.rotate_deg = random.point(-180, 180);
        instance.transform.scale = {size, size, size};
    }
    d.camera = fit_camera(subject_bounds(d), 4.0 / 3);
    return d;
}

void scale_instances(const Options& options, Report& report)
{
    if (!options.wants("instances")) return;
    Sizes sizes(options, report);
    for (uint32_t count = 1; count <= (options.full ? 100'000u : 10'000u); count *= 10)
        sizes.measure("instances", count, uint64_t{400} * count, Stage(instances_of(count), small_picture()));
    sizes.finish("instances", 0);
}

}  // namespace
}  // namespace lancer::bench

int main(int argc, char** argv)
{
    using namespace lancer::bench;
    return run_program(
        argc, argv, "bench_scaling",
        "Shows how building and speed go with the number of triangles, lights and instances, and fits exponents to "
        "it.\nNames for --only: sphere, subdivided-armadillo, lights, instances.",
        [](const Options& options, Report& report) {
            lancer::with_threads(options.threads, [&] {
                scale_triangles(options, report);
                scale_lights(options, report);
                scale_instances(options, report);
            });
        });
}
