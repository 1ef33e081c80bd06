// bench_features: what the things cost that a scene does without. Each is compiled and unused, there and unseen, and
// left out.
#include <algorithm>

#include "app/console.h"
#include "core/parallel.h"
#include "harness/feature_scenes.h"
#include "harness/instructions.h"
#include "harness/meshes.h"
#include "harness/stage.h"
#include "report/bench/interval.h"
#include "report/metrics/picture_pairs.h"
#include "report/metrics/statistics.h"
#include "unused.h"

namespace lancer::bench {
namespace {

// ---- pictures

template <class T>
uint64_t bytes_of(const std::vector<T>& v)
{
    return v.size() * sizeof(T);
}

// All tables that grow with a scene or its picture.
uint64_t bytes_of(const Stage& stage, const Film& film)
{
    const Scene& s = stage.scene;
    uint64_t bytes = stage.renderer.accelerator().stats().bytes + bytes_of(s.geometry.spheres) +
                     bytes_of(s.geometry.planes) + bytes_of(s.geometry.instances) + bytes_of(s.materials) +
                     bytes_of(s.traits) + bytes_of(s.emission) + bytes_of(s.textures) + bytes_of(s.lights.lights);
    for (const Mesh& m : s.geometry.meshes) bytes += bytes_of(m.positions) + bytes_of(m.triangles);
    for (const MeshShading& m : s.shading)
        bytes += m.normals.bytes() + bytes_of(m.uvs) + m.uv_triangles.bytes() + m.face_material.bytes() +
                 m.emitters.bytes() + bytes_of(m.colors);
    for (const std::vector<uint8_t>& asked : s.geometry.alpha_test.meshes) bytes += bytes_of(asked);
    for (const Texture& t : s.textures)
        if (const auto* image = std::get_if<ImageTexture>(&t)) bytes += image->bytes();
    return bytes + bytes_of(film.pixels) + bytes_of(film.aovs) + bytes_of(film.wanted) + bytes_of(film.replicates);
}

RenderSettings small_picture()
{
    RenderSettings s;
    s.give(&RenderSettings::size, {96, 72});
    s.give(&RenderSettings::filter, FilterKind::box);
    s.give(&RenderSettings::accel, AccelKind::embree);  // the same whatever the number of triangles
    return s;
}

constexpr uint32_t spp = 4;

struct Picture {
    std::unique_ptr<Stage> stage;
    std::unique_ptr<Renderer> renderer;  // instead of the stage's, if it is forced to something
    Film film{0, 0, {}};

    Picture(const SceneDescription& d, const RenderSettings& options, std::optional<Profile> profile)
        : stage(std::make_unique<Stage>(d, options)), film(stage->film())
    {
        if (!profile) return;
        RendererConfig settings = stage->config;
        settings.kernel.profile = profile;
        Diagnostics unheard;
        renderer = std::make_unique<Renderer>(Scene::build(d, d.render, unheard), settings);
    }
    double samples() const { return static_cast<double>(film.width) * film.height * spp; }
    // From an empty film, with all that was asked of it.
    void draw() const
    {
        Film drawn = film;
        (renderer ? *renderer : stage->renderer).pass(stage->camera, drawn, stage->tiles(), {0, spp});
        keep(drawn.pixels);
    }
};

double milliseconds_to_build(const SceneDescription& d, const RenderSettings& options)
{
    std::vector<double> times;
    for (int i = 0; i < 5; ++i) {
        const double start = thread_ns();
        const Stage stage(d, options);
        times.push_back(1e-6 * (thread_ns() - start));
    }
    return median(times);
}

void measure_unseen(const Base& base, const Feature& feature, const Options& options, Report& report)
{
    SceneDescription with = base.description;
    RenderSettings picture = small_picture(), with_picture = picture;
    Film none(0, 0, {});
    feature.bring(with, with_picture, none);
    Picture chosen(base.description, picture, {}), all(base.description, picture, Profile::all),
        unseen(with, with_picture, Profile::all);
    feature.bring(with = base.description, with_picture, unseen.film);
    const std::vector<Contestant> contestants{{"unseen", unseen.samples(), [&] { unseen.draw(); }},
                                              {"all", all.samples(), [&] { all.draw(); }},
                                              {"chosen", chosen.samples(), [&] { chosen.draw(); }}};
    const std::vector<Timing> timings = take_turns(contestants, options.repetitions, 1);
    Json& row = report.add("features", joined({"unseen", base.name, feature.name}), timings[1], 1);
    row["mesh"] = base.name, row["way"] = feature.name;
    const auto bytes =
        static_cast<double>(bytes_of(*unseen.stage, unseen.film)) - static_cast<double>(bytes_of(*all.stage, all.film));
    row["bytes"] = bytes;
    row["bytes_per_triangle"] = bytes / static_cast<double>(all.stage->scene.triangle_count());
    row["startup_ms"] = milliseconds_to_build(with, with_picture) - milliseconds_to_build(base.description, picture);
    const Spread saved = spread_of(speed_ratios(timings[0].cpu, timings[2].cpu));
    row["saved_in_all"] = saved.median;  // by the kernel that the scene gets without it
    add_ratio(row, "unseen", timings[0], timings[1], 1);
    print_row(row);
}

// ---- the kernel for all, and what its code costs where nothing uses it

// One way to draw the picture. draw() adds samples [0, end) to the film.
struct Way {
    std::string name, than;  // than: of the way with which it is compared
    std::function<void(Film&, const Tile&, uint32_t end, Workspace&)> draw;
};

// As measure_unused() sees the picture. All must outlive what is made of it.
struct Pictured {
    const Stage& stage;
    const SamplingPlan& plan;
    const Path path = std::get<Path>(stage.config.integrator);

    template <class V>
    Way way(const std::string& name, const Calls& calls = {}, const std::string& than = "everything") const
    {
        return {name, than, [this, calls](Film& film, const Tile& tile, uint32_t end, Workspace& w) {
                    Counters counters;
                    render_tile(V{view(calls)}, stage.renderer.accelerator(), stage.camera, stage.config.kernel, path,
                                film, tile, SampleRange{0, end}, w, counters, NoListener{});
                }};
    }
    template <unsigned without>
    Way without_surfaces(const std::string& name) const
    {
        return way<Everything>(name, surfaces_without<without>(), "surfaces that are asked");
    }
    template <unsigned without>
    Way without_lights(const std::string& name) const
    {
        return way<Everything>(name, lights_without<without>(), "lights that are asked");
    }
    Everything view(const Calls& calls) const { return {{stage.scene, plan}, calls}; }
    // The product's own.
    Way product() const
    {
        return {"product", {}, [this](Film& film, const Tile& tile, uint32_t end, Workspace& w) {
                    Counters counters;
                    Kernels<Path>::render(View{stage.scene, plan}, stage.renderer.accelerator(), stage.camera,
                                          stage.config.kernel, path, film, tile, SampleRange{0, end}, w, counters);
                }};
    }
};

void measure_unused(const Base& base, const Options& options, Report& report)
{
    RenderSettings small = small_picture();  // short runs take turns more often; valgrind takes a hundred times as long
    small.give(&RenderSettings::size, is_under_valgrind() ? PictureSize{24, 18} : PictureSize{48, 36});
    const Picture picture(base.description, small, {});
    const Stage& stage = *picture.stage;
    const auto plan = stage.renderer.plan(stage.camera, picture.film.width, picture.film.height);
    const Pictured p{stage, *plan};
    const std::vector<Way> ways{
        p.product(),
        p.way<Everything>("everything", {}, "product"),
        p.way<NoMixes>("mixes"),
        p.way<OnlyLambert>("materials but Lambert"),
        p.way<NoTextures<false>>("textures, of materials"),
        p.way<NoTextures<true>>("vertex colours, of materials"),
        p.way<NoCutOuts>("cut-outs"),
        p.way<NoMedia>("media"),
        p.way<NoLightTree>("light tree"),
        p.way<NoSky>("sky"),
        p.way<PlainEmission>("textures, of what shines"),
        p.way<NoLens>("thin lens"),
        p.way<NoWideFilter>("wide filters"),
        p.way<Everything>("surfaces that are asked", surfaces_without<0>()),
        p.way<Everything>("lights that are asked", lights_without<0>()),
        p.without_lights<other_lights>("lights but triangles"),
        p.without_lights<placed_lights>("lights of instances"),
        p.without_lights<textured_lights>("textures of lights"),
        p.without_lights<lights_with_holes>("cut-outs of lights"),
        p.without_lights<light_tree>("densities of a light tree"),
        p.without_lights<all_of_lights>("lights but flat triangles of one colour"),
        p.without_surfaces<shapes>("spheres and planes"),
        p.without_surfaces<instances>("instances"),
        p.without_surfaces<vertex_normals>("vertex normals"),
        p.without_surfaces<vertex_colors>("vertex colours"),
        p.without_surfaces<textures>("textures"),
        p.without_surfaces<maps>("bump and normal maps"),
        p.without_surfaces<legacy>("legacy"),
        p.without_surfaces<all_of_them>("surfaces but flat triangles"),
    };
    const auto draw = [&](const Way& way, uint32_t end) {
        Film film = picture.film;
        Workspace w;
        for (const Tile& tile : stage.tiles()) way.draw(film, tile, end, w);
        return film;
    };
    const Film right = draw(ways[0], spp);
    std::vector<Contestant> contestants;
    for (const Way& way : ways) {
        if (differing_pixels(draw(way, spp), right) > 0)
            report.fail(base.name + " without " + way.name + ": other bits");
        contestants.push_back({way.name, picture.samples() / spp, [&] { keep(draw(way, 1).pixels); }});
    }
    constexpr unsigned rounds = 40;  // for each repetition that is asked for
    const std::vector<Timing> timings =
        take_turns(contestants, is_under_valgrind() ? 1 : rounds * options.repetitions, 1);
    for (size_t i = 1; i < ways.size(); ++i) {
        const auto than = std::find_if(ways.begin(), ways.end(), [&](const Way& w) { return w.name == ways[i].than; });
        Json& row = report.add("features", joined({"unused", base.name, ways[i].name}), timings[i], 1);
        row["mesh"] = base.name, row["way"] = ways[i].name;
        add_ratio(row, than->name, timings[static_cast<size_t>(than - ways.begin())], timings[i], 1);
        print_row(row);
    }
}

void measure_saved(const Base& base, const Options& options, Report& report)
{
    const Picture chosen(base.description, small_picture(), {}), all(base.description, small_picture(), Profile::all);
    const std::vector<Timing> timings =
        take_turns({{"all", all.samples(), [&] { all.draw(); }}, {"chosen", chosen.samples(), [&] { chosen.draw(); }}},
                   options.repetitions, 1);
    Json& row = report.add("features", joined({"saved", base.name}), timings[1], 1);
    row["mesh"] = base.name, row["way"] = std::string(name_of(chosen.stage->renderer.profile()));
    add_ratio(row, "all", timings[0], timings[1], 1);
    print_row(row);
}

// ---- whole files

void measure_scene(const SharedRoom& room, const Options& options, Report& report)
{
    const std::string file = shared_scene(room.file, options.cache);
    if (file.empty() || !options.wants(room.name)) return;
    const double start = wall_ns();
    const SceneDescription description = load_description(file);
    const Picture picture(description, small_picture(), {});
    const double seconds = 1e-9 * (wall_ns() - start);
    Json& row = report.add("features", joined({"scene", room.name}));
    row["mesh"] = room.name;
    const auto triangles = static_cast<double>(picture.stage->scene.triangle_count());
    uint64_t textures = 0;
    for (const Texture& t : picture.stage->scene.textures)
        if (const auto* image = std::get_if<ImageTexture>(&t)) textures += image->bytes();
    row["triangles"] = triangles;
    row["bytes_per_triangle"] = static_cast<double>(bytes_of(*picture.stage, Film(0, 0, {})) - textures) / triangles;
    row["texture_bytes"] = textures;
    row["seconds_to_first_ray"] = seconds;
    for (const UnusedFeature& l : picture.stage->scene.unused_features.all()) row["left_out: " + l.what] = l.bytes;
    print_row(row);
}

}  // namespace
}  // namespace lancer::bench

int main(int argc, char** argv)
{
    using namespace lancer::bench;
    return run_program(
        argc, argv, "bench_features",
        "What the things cost that a scene does without: there and unseen (unseen/...), compiled and unused "
        "(unused/...), and what the kernel for plain scenes saves (saved/...).\nWhole files: bytes per triangle, "
        "seconds to the first ray.",
        [](const Options& options, Report& report) {
            lancer::with_threads(1, [&] {
                std::vector<Base> bases{make_base("walls", 0)};
                if (options.full || !options.only.empty()) bases.push_back(make_base("room", 100'000));
                for (const Base& base : bases) {
                    if (!options.wants(base.name)) continue;
                    if (is_under_valgrind()) {  // which counts, and tells no times
                        measure_unused(base, options, report);
                        continue;
                    }
                    measure_saved(base, options, report);
                    measure_unused(base, options, report);
                    for (const Feature& feature : features()) measure_unseen(base, feature, options, report);
                }
                // The scene of the project that gets a kernel of its own.
                if (options.wants("cornell") && !is_under_valgrind())
                    measure_saved({"cornell", load_description(scene_file("cornell"))}, options, report);
            });
            for (const SharedRoom& room : shared_rooms()) measure_scene(room, options, report);
        });
}
