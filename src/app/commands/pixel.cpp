// lancer pixel: one sample again, with the bits that a render gives it, and every vertex on the way.
#include <memory>
#include <string>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/prepare.h"
#include "core/names.h"
#include "core/parallel.h"
#include "integrators/view.h"
#include "scene/camera.h"

namespace lancer {
namespace {

// 9 digits tell every float from its neighbours.
std::string numbers_of(Vec3d v) { return format_text("(%.9g, %.9g, %.9g)", v.x, v.y, v.z); }
std::string numbers_of(Vec3 v) { return numbers_of(to_double(v)); }
std::string numbers_of(Color c) { return numbers_of(Vec3d{double(c.r), double(c.g), double(c.b)}); }

// Prints what the kernel reports, in the units of the scene file.
class Report {
public:
    Report(const Renderer& renderer, const SceneDescription& description, std::shared_ptr<const SamplingPlan> plan)
        : scene_(renderer.scene()), description_(description), plan_(std::move(plan))
    {
    }
    PathListener listener()
    {
        return {.ray = [this](const PathState& s, const Hit& h) { print_ray(s, h); },
                .vertex = [this](const PathState&, const Surface& s) { print_vertex(s); },
                .added = [](const PathState&, Color c) { print_result("  added          " + numbers_of(c)); },
                .shadow = [this](const Ray& r, Color c, bool occluded) { print_shadow_ray("", r, c, occluded); },
                .mirrored_shadow = [this](const Ray& r, Color c,
                                          bool occluded) { print_shadow_ray(" by way of a mirror,", r, c, occluded); },
                .scattered = [this](const PathState& s, float t) { print_scattered(s, t); }};
    }

private:
    std::string place(Vec3 p) const { return numbers_of(scene_.normalisation.to_file(to_double(p))); }
    double distance(float t) const { return double(t) / scene_.normalisation.scale; }

    std::string part_of_bubble(uint32_t sphere) const
    {
        if (sphere >= description_.spheres.size()) return "";  // a light
        const SphereDescription& s = description_.spheres[sphere];
        if (s.part == SphereDescription::Part::whole) return "";
        return (s.part == SphereDescription::Part::bubble ? ", the outside of the bubble at "
                                                          : ", the inside of the bubble at ") +
               to_string(s.where);
    }
    std::string name_of(const Hit& h) const
    {
        if (h.kind == Kind::sphere) return format_text("sphere %u", h.primitive) + part_of_bubble(h.primitive);
        if (h.kind == Kind::plane) return format_text("plane %u", h.primitive);
        const MeshDescription& mesh = description_.meshes[h.geometry];
        if (!mesh.data->shape.empty())
            return format_text("triangle %u of the ", h.primitive) + mesh.data->shape + " at " + to_string(mesh.where);
        std::string text = format_text("triangle %u of mesh %u", h.primitive, h.geometry) + " " +
                           in_quotes(mesh.name.empty() ? mesh.data->file : mesh.name);
        if (h.instance != Hit::no_instance) text += format_text(", instance %u", h.instance);
        return text;
    }
    void print_ray(const PathState& s, const Hit& h) const
    {
        print_result(format_text("ray at depth %u%s%s", s.depth, s.specular ? ", specular" : "",
                                 s.last ? ", last: only emission counts" : ""));
        print_result("  origin         " + place(s.ray.org));
        print_result("  direction      " + numbers_of(s.ray.dir));
        print_result("  throughput     " + numbers_of(s.throughput));
        const View view{scene_, *plan_};
        const float rate = s.light_sampled ? view.light_rate(s.cell) : 1;
        if (s.pdf > 0) print_result(format_text("  pdf            %.9g", double(s.pdf * rate)));
        if (rate < 1) print_result(format_text("  light sampled  with probability %g at its origin", double(rate)));
        if (!h) {
            print_result("  left the scene");
            return;
        }
        print_result("  hit            " + name_of(h));
        print_result(format_text("  t              %.9g", distance(h.t)));
        if (h.kind == Kind::triangle)
            print_result(format_text("  u, v           %.9g, %.9g", double(h.uv.x), double(h.uv.y)));
    }
    void print_vertex(const Surface& s) const
    {
        print_result("  point          " + place(s.p));
        print_result("  normal         " + numbers_of(s.n) + (s.front ? ", front side" : ", back side"));
        print_result("  shading normal " + numbers_of(s.ns));
        print_result(format_text("  material       %u ", s.material) + in_quotes(scene_.material_names[s.material]));
    }
    void print_scattered(const PathState& s, float t) const
    {
        print_result(format_text("  scattered at   %.9g", distance(t)));
        print_result("  point          " + place(s.ray.org + s.ray.dir * t));
    }
    void print_shadow_ray(const char* way, const Ray& r, Color carried, bool occluded) const
    {
        print_result(std::string("  shadow ray") + way + " from " + place(r.org) + " towards " + numbers_of(r.dir) +
                     (std::isfinite(r.t_max) ? format_text(", length %.9g", distance(r.t_max)) : ", without end"));
        print_result("    carries " + numbers_of(carried) + (occluded ? ": occluded" : ": arrives"));
    }

    const Scene& scene_;
    const SceneDescription& description_;
    std::shared_ptr<const SamplingPlan> plan_;
};

}  // namespace

int run_pixel(int argc, char** argv)
{
    const auto options = parse_pixel(argc, argv);
    if (!options) return exit_done;
    Diagnostics diagnostics;
    Prepared p = load_prepared(options->picture, diagnostics, true);
    const uint32_t width = p.settings.size.width, height = p.settings.size.height;
    if (options->x >= width || options->y >= height)
        throw Error(
            ErrorKind::usage, {},
            format_text("pixel %u %u lies outside of the picture of %ux%u", options->x, options->y, width, height));
    with_threads(p.threads, [&] {
        begin_prepared(p, diagnostics);
        const auto made = make_renderer(p, options->picture, 1, diagnostics);
        const Renderer& renderer = *made;
        const Camera camera(p.description, renderer.scene().normalisation, width, height, pixel_grid(p.settings));
        Report report(renderer, p.description, renderer.plan(camera, width, height));
        const Color radiance =
            renderer.replay(camera, width, height, {options->x, options->y, options->sample}, report.listener());
        print_result("radiance " + numbers_of(radiance) +
                     (is_finite(radiance) ? "" : ": not finite, dropped from pictures"));
    });
    return exit_done;
}

}  // namespace lancer
