// lancer info: what is in a scene and what it takes, or what a picture says of its making.
#include <map>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/defaults/complete_scene.h"
#include "app/info_json.h"
#include "app/load_scene.h"
#include "app/options/option_values.h"
#include "app/options/options.h"
#include "app/paths.h"
#include "app/picture_memory.h"
#include "app/prepare.h"
#include "app/print_plan.h"
#include "app/scene_facts.h"
#include "app/specialisation.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/image/exr.h"
#include "io/image/png.h"
#include "io/image/read.h"

namespace lancer {
namespace {

void print_field(const char* name, const std::string& value) { print_result(format_text("%-13s ", name) + value); }

std::string megabytes(uint64_t bytes) { return format_text("%.2f MB", 1e-6 * static_cast<double>(bytes)); }

// "3 lambert, 1 glass"
std::string listed(const std::map<std::string, uint64_t>& counts)
{
    std::string text;
    for (const auto& [name, n] : counts)
        if (n) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + name;
    return text.empty() ? "none" : text;
}

// For listed(): what some are called, and one alone.
std::pair<const std::string, uint64_t> of_kind(const char* one, const char* several, uint64_t n)
{
    return {n == 1 ? one : several, n};
}

std::string to_text(Vec3d v) { return format_text("%.7g %.7g %.7g", v.x, v.y, v.z); }

std::string listed(const SceneFacts& facts)
{
    std::map<std::string, uint64_t> counts;
    for (size_t i = 0; i < facts.shapes.size(); ++i)
        counts.insert(of_kind(shape_names[i][0], shape_names[i][1], facts.shapes[i]));
    return listed(counts);
}

std::string joined(const std::vector<std::string>& words, const std::string& none)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text.empty() ? none : text;
}

void print_facts(const SceneFacts& f)
{
    print_field("file", f.file);
    print_field("triangles", format_text("%zu, drawn %zu", size_t{f.triangles}, size_t{f.drawn}));
    print_field("vertices", std::to_string(f.vertices));
    print_field("shapes", listed(f));
    if (f.bounds.extent() > 0) print_field("bounds", to_text(f.bounds.lower) + " to " + to_text(f.bounds.upper));
    print_field("materials", listed(f.materials));
    for (const SceneFacts::Reason& m : f.reasons) print_field("material", m.name + ": " + m.type + ", by " + m.why);
    for (const std::string& sheet : f.sheets) print_field("sheets", sheet);
    for (const std::string& division : f.divisions) print_field("divided", division);
    std::string sizes;
    for (const SceneFacts::ImageSize& image : f.images)
        sizes += format_text("%s%ux%u (%s)", sizes.empty() ? "" : ", ", image.width, image.height,
                             megabytes(image.bytes).c_str());
    print_field("textures",
                listed({of_kind("image", "images", f.images.size()), of_kind("other", "others", f.other_textures)}) +
                    (sizes.empty() ? "" : ": " + sizes));
    std::map<std::string, uint64_t> lights = f.lights;
    lights.insert(of_kind("emitting triangle", "emitting triangles", f.emitting_triangles));
    print_field("lights", listed(lights));
    if (!f.sky.empty())
        print_field("background", "sky: " + f.sky + ", ground: " + f.ground + (f.has_glow ? ", glow of lights" : ""));
    std::vector<std::string> cameras = f.cameras;
    if (f.has_unnamed_camera) cameras.insert(cameras.begin(), "the unnamed one");
    for (std::string& name : cameras) name = on_one_line(name);
    print_field("cameras", joined(cameras, "none; one that sees the whole scene is added"));
    print_field("memory", "geometry " + megabytes(f.bytes.geometry) + ", shading " + megabytes(f.bytes.shading) +
                              ", textures " + megabytes(f.bytes.textures) + ", lights " + megabytes(f.bytes.lights) +
                              ", accelerator " + megabytes(f.bytes.accelerator));
    print_field("features", joined(f.features, "none"));
}

void print_metadata(const Metadata& metadata)
{
    for (const auto& [name, value] : metadata) print_field(name.c_str(), to_string(value));
}

std::string to_text(const Window& w) { return format_text("%dx%d at %d %d", w.width(), w.height(), w.x0, w.y0); }

void print_picture(const std::string& path)
{
    if (extension_of(path) == ".exr") {
        const ExrInfo info = read_exr_info(path);
        print_field("file", path);
        print_field("size", format_text("%dx%d", info.display.width(), info.display.height()));
        if (info.data != info.display) print_field("pixels", to_text(info.data));
        std::string channels;
        for (const auto& c : info.channels) channels += (channels.empty() ? "" : ", ") + c.name + " " + c.type;
        print_field("channels", channels);
        print_field("compression", info.compression);
        if (info.tile_width > 0) print_field("tiles", format_text("%ux%u", info.tile_width, info.tile_height));
        if (info.parts > 1) print_field("parts", std::to_string(info.parts));
        if (info.space != ColorSpace::lin_rec709) print_field("color space", std::string(name_of(info.space)));
        return print_metadata(info.metadata);
    }
    if (extension_of(path) == ".png") {
        const PngInfo info = read_png_info(path);
        print_field("file", path);
        print_field("size", format_text("%ux%u", info.width, info.height));
        print_field("channels", format_text("%u of %u bits", info.channels, info.bits));
        return print_metadata(info.metadata);
    }
    const RasterHeader header = read_raster_header(path);
    print_field("file", path);
    print_field("size", format_text("%ux%u", header.width, header.height));
    print_field("channels", std::to_string(header.channels));
    print_metadata(read_picture_metadata(path));
}

int print_scene(const InfoOptions& options)
{
    Diagnostics diagnostics;
    const SceneDescription description = load_scene(options.scene, diagnostics);
    const RenderSettings settings = resolve_settings({}, description.render);
    const RendererConfig config = configure(settings, 1);
    if (options.plan && !std::holds_alternative<Path>(config.integrator))
        fail_usage("--plan: the integrator of the scene has no pilot; only path has one, without legacy");
    const unsigned threads = options.threads.value_or(available_threads());
    SceneDescription completed = description;  // what is added is not told of, nor is that it lacks
    with_threads(threads, [&] {
        PictureMemory memory = memory_for(options.memory, threads);
        ImageSource images(threads, memory.ahead);
        serve(memory, images);
        complete_scene(completed, options.scene, aspect_of(settings.size), images.source(), memory);
        const Renderer renderer(SceneBuilder(completed, settings, diagnostics, images.source(), memory), config,
                                diagnostics);
        const SceneFacts facts = facts_of(description, renderer.scene(), renderer.accelerator());
        const auto unused = unused_features_of(renderer, renderer.profile());
        if (options.json) return print_result(scene_json(facts, renderer.profile(), unused, diagnostics));
        print_facts(facts);
        print_field("kernel", std::string(name_of(renderer.profile())));
        print_field("unused", "");
        for (const UnusedFeature& l : unused) print_result("  " + to_string(l));
        if (options.plan) print_plan(renderer, *completed.camera, settings.size, options.plan_map);
    });
    if (options.json) return exit_done;
    print_field("warnings", diagnostics.warnings().empty() ? "none" : "");
    for (const auto& warning : diagnostics.warnings()) print_result("  " + to_string(warning));
    return exit_done;
}

}  // namespace

int run_info(int argc, char** argv)
{
    const auto options = parse_info(argc, argv);
    if (!options) return exit_done;
    if (is_scene(options->scene.file)) return print_scene(*options);
    if (options->json)
        print_result(picture_json(options->scene.file));
    else
        print_picture(options->scene.file);
    return exit_done;
}

}  // namespace lancer
