// lancer info: what is in a scene and what it takes, or what a picture says of its making.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/defaults/complete_scene.h"
#include "app/load_scene.h"
#include "app/options/option_values.h"
#include "app/options/options.h"
#include "app/paths.h"
#include "app/picture_memory.h"
#include "app/prepare.h"
#include "app/print_plan.h"
#include "app/specialisation.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/image/exr.h"
#include "io/image/png.h"
#include "io/image/read.h"
#include "scene/environment/background.h"
#include "scene/features.h"

namespace lancer {
namespace {

void print_field(const char* name, const std::string& value) { print_result(format_text("%-13s ", name) + value); }

std::string megabytes(uint64_t bytes) { return format_text("%.2f MB", 1e-6 * static_cast<double>(bytes)); }

template <class T>
uint64_t bytes_of(const std::vector<T>& v)
{
    return v.size() * sizeof(T);
}

template <class T, class F>
uint64_t count(const std::vector<T>& v, const F& is_meant)
{
    return static_cast<uint64_t>(std::count_if(v.begin(), v.end(), is_meant));
}

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

class SceneInfo {
public:
    SceneInfo(const SceneDescription& description, const Scene& scene, const Accelerator& accel)
        : d_(description), scene_(scene), accel_(accel)
    {
    }
    void print() const
    {
        print_field("file", d_.file);
        print_shapes();
        print_materials();
        for (const Scene::Note& note : scene_.sheets) print_field("sheets", note.text);
        print_textures();
        print_lights();
        print_background();
        print_cameras();
        print_memory();
        print_field("features", features());
    }

private:
    void print_shapes() const
    {
        uint64_t drawn = 0, vertices = 0;
        for (const Mesh& m : scene_.geometry.meshes) {
            vertices += m.vertices();
            if (!m.instanced) drawn += m.triangles.size();
        }
        for (const Instance& i : scene_.geometry.instances) drawn += scene_.geometry.meshes[i.mesh].triangles.size();
        print_field("triangles", format_text("%zu, drawn %zu", size_t{scene_.triangle_count()}, size_t{drawn}));
        print_field("vertices", std::to_string(vertices));
        const auto meshes = [&](const char* shape) {
            return count(d_.meshes, [&](const MeshDescription& m) { return m.data->shape == shape; });
        };
        using Part = SphereDescription::Part;
        const auto spheres = [&](Part part) {
            return count(d_.spheres, [&](const SphereDescription& s) { return s.part == part; });
        };
        const uint64_t water = count(d_.planes, [](const PlaneDescription& p) { return p.is_water; });
        print_field("shapes",
                    listed({of_kind("mesh", "meshes", meshes("")), of_kind("triangle", "triangles", meshes("triangle")),
                            of_kind("pyramid", "pyramids", meshes("pyramid")),
                            of_kind("instance", "instances", d_.instances.size()),
                            of_kind("sphere", "spheres", spheres(Part::whole)),
                            of_kind("bubble", "bubbles", spheres(Part::bubble)),
                            of_kind("plane", "planes", d_.planes.size() - water),
                            of_kind("plane of water", "planes of water", water)}));
        const Bounds b = subject_bounds(d_);
        if (b.extent() > 0) print_field("bounds", to_text(b.lower) + " to " + to_text(b.upper));
    }
    void print_materials() const
    {
        std::map<std::string, uint64_t> counts;
        for (uint32_t i = 0; i < scene_.materials.size(); ++i) {
            const bool is_mix = !scene_.mix_of.empty() && scene_.mix_of[i] != Scene::none;
            const MaterialType type = std::visit([](const auto& m) { return m.type; }, scene_.materials[i]);
            ++counts[std::string(name_of(is_mix ? MaterialType::mix : type))];
        }
        print_field("materials", listed(counts));
        std::set<std::string> told;
        for (const MeshDescription& mesh : d_.meshes)
            for (const MaterialDescription& m : mesh.data->materials) {
                if (m.why.empty() || !told.insert(m.where.file + '\n' + m.name).second) continue;
                print_field("material", m.name + ": " + std::string(name_of(m.type)) + ", by " + m.why);
            }
    }
    void print_textures() const
    {
        uint64_t images = 0;
        std::string sizes;
        for (const Texture& t : scene_.textures)
            if (const auto* image = std::get_if<ImageTexture>(&t)) {
                ++images;
                sizes += format_text("%s%ux%u (%s)", sizes.empty() ? "" : ", ", image->width(), image->height(),
                                     megabytes(image->bytes()).c_str());
            }
        print_field("textures", listed({of_kind("image", "images", images),
                                        of_kind("other", "others", scene_.textures.size() - images)}) +
                                    (sizes.empty() ? "" : ": " + sizes));
    }
    void print_lights() const
    {
        std::map<std::string, uint64_t> counts;
        uint64_t triangles = 0;
        for (const LightDescription& l : d_.lights) ++counts[std::string(name_of(l.type))];
        for (const Light& l : scene_.lights.lights)
            if (std::holds_alternative<TriangleLight>(l)) ++triangles;
        counts.insert(of_kind("emitting triangle", "emitting triangles", triangles));
        print_field("lights", listed(counts));
    }
    void print_background() const
    {
        if (!d_.background) return;
        const BackgroundDescription& b = *d_.background;
        constexpr std::array skies{"a colour", "gradient", "night", "dawn", "dusk", "noon", "picture"};
        constexpr std::array grounds{"none", "a colour", "checker", "picture"};
        const auto sized = [](const char* name, const auto& picture) {
            return picture ? format_text("%s %dx%d", name, int(picture->width()), int(picture->height())) : name;
        };
        std::string sky = skies[static_cast<size_t>(b.sky)], ground = grounds[static_cast<size_t>(b.ground)];
        if (const Background* made = scene_.background.get()) {
            sky = sized(sky.c_str(), made->sky_picture());
            ground = made->ground_plane() ? sized(ground.c_str(), made->ground_plane())
                                          : sized(ground.c_str(), made->ground_picture());
        }
        print_field("background", "sky: " + sky + ", ground: " + ground + (b.glow ? ", glow of lights" : ""));
    }
    void print_cameras() const
    {
        std::string names = d_.camera && d_.camera->name.empty() ? "the unnamed one" : "";
        for (const CameraDescription& c : d_.cameras) names += (names.empty() ? "" : ", ") + on_one_line(c.name);
        print_field("cameras", names.empty() ? "none; one that sees the whole scene is added" : names);
    }
    void print_memory() const
    {
        uint64_t geometry =
            bytes_of(scene_.geometry.spheres) + bytes_of(scene_.geometry.planes) + bytes_of(scene_.geometry.instances);
        for (const Mesh& m : scene_.geometry.meshes) geometry += bytes_of(m.positions) + bytes_of(m.triangles);
        uint64_t shading = 0, textures = 0;
        for (const MeshShading& s : scene_.shading)
            shading += s.normals.bytes() + bytes_of(s.uvs) + s.uv_triangles.bytes() + s.face_material.bytes() +
                       s.emitters.bytes();
        for (const Texture& t : scene_.textures)
            if (const auto* image = std::get_if<ImageTexture>(&t)) textures += image->bytes();
        print_field("memory", "geometry " + megabytes(geometry) + ", shading " + megabytes(shading) + ", textures " +
                                  megabytes(textures) + ", lights " + megabytes(bytes_of(scene_.lights.lights)) +
                                  ", accelerator " + megabytes(accel_.stats().bytes));
    }
    std::string features() const
    {
        std::string text;
        const auto add = [&](bool used, std::string_view name) {
            if (used) text += (text.empty() ? "" : ", ") + std::string(name);
        };
        const Features has = features_of(scene_);
        for (size_t i = 0; i < static_cast<size_t>(Feature::count); ++i)
            add(has.has(static_cast<Feature>(i)), name_of(static_cast<Feature>(i)));
        add(!d_.overrides.empty(), "material overrides");
        return text.empty() ? "none" : text;
    }

    const SceneDescription& d_;
    const Scene& scene_;
    const Accelerator& accel_;
};

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
        SceneInfo(description, renderer.scene(), renderer.accelerator()).print();
        print_field("kernel", std::string(name_of(renderer.profile())));
        print_field("unused", "");
        for (const UnusedFeature& l : unused_features_of(renderer, renderer.profile()))
            print_result("  " + to_string(l));
        if (options.plan) print_plan(renderer, *completed.camera, settings.size, options.plan_map);
    });
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
    print_picture(options->scene.file);
    return exit_done;
}

}  // namespace lancer
