#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "app/api/lancer.h"
#include "app/console.h"
#include "app/exit_code.h"
#include "app/prepare.h"
#include "app/version.h"
#include "app/whole_film.h"
#include "core/lanes/denormals.h"
#include "core/names.h"
#include "core/parallel.h"
#include "io/mesh_values.h"
#include "render/aov.h"
#include "scene/camera.h"

namespace {

using namespace lancer;

static_assert(LANCER_OK == exit_done && LANCER_FAILED == exit_failed && LANCER_USAGE == exit_usage &&
              LANCER_INVALID_INPUT == exit_invalid && LANCER_MISSING_INPUT == exit_missing &&
              LANCER_NO_MEMORY == exit_no_memory && LANCER_CANCELLED == exit_interrupted);

thread_local std::string last_error;

// Runs f() on a thread of its own, whose mode for denormals is that of the program; the caller's stays as it is.
// Returns what f() returns, or the code of what it throws.
template <class F>
int guarded_apart(const F& f)
{
    Failure result{LANCER_FAILED, ""};
    try {
        std::thread([&] {
            set_flush_denormals();
            const SilentConsole silent;
            try {
                result.code = f();
            } catch (const std::exception&) {
                result = current_failure();
            }
        }).join();
    } catch (const std::exception&) {  // there is no thread
        result = current_failure();
    }
    if (result.code != LANCER_OK) last_error = result.text;
    return result.code;
}

[[noreturn]] void fail_usage_of_api(const std::string& message) { throw Error(ErrorKind::usage, "error: " + message); }

constexpr std::string_view color_layer = "color";

std::shared_ptr<const MeshData> data_of(const lancer_mesh& m)
{
    if (!m.positions || !m.triangles || m.vertices == 0 || m.triangle_count == 0)
        fail_usage_of_api("a mesh needs positions and triangles");
    if (m.vertices >= UINT32_MAX) fail_usage_of_api("a mesh has too many vertices");
    auto data = std::make_shared<MeshData>();
    data->shape = m.name ? m.name : "mesh";
    data->positions.resize(m.vertices);
    for (size_t i = 0; i < m.vertices; ++i) {
        const double* p = m.positions + 3 * i;
        data->positions[i] = {p[0], p[1], p[2]};
        if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
            fail_usage_of_api("vertex " + std::to_string(i) + " of a mesh is not finite");
    }
    data->triangles.resize(m.triangle_count);
    for (size_t i = 0; i < m.triangle_count; ++i)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t index = m.triangles[3 * i + k];
            if (index >= m.vertices)
                fail_usage_of_api("triangle " + std::to_string(i) + " of a mesh has a vertex that does not exist");
            data->triangles[i][k] = index;
        }
    if (m.normals) {
        data->normals.resize(m.vertices);
        for (size_t i = 0; i < m.vertices; ++i) {
            const Vec3 n = unit_normal(to_double(Vec3{m.normals[3 * i], m.normals[3 * i + 1], m.normals[3 * i + 2]}));
            if (!is_finite(n) || n == Vec3{})
                fail_usage_of_api("normal " + std::to_string(i) + " of a mesh has no direction");
            data->normals[i] = n;
        }
        data->normal_triangles = data->triangles;
    }
    if (m.uvs) {
        data->uvs.resize(m.vertices);
        for (size_t i = 0; i < m.vertices; ++i) {
            data->uvs[i] = uv_of(double{m.uvs[2 * i]}, double{m.uvs[2 * i + 1]});
            if (is_broken(data->uvs[i]))
                fail_usage_of_api("texture coordinate " + std::to_string(i) + " of a mesh is not finite");
        }
        data->uv_triangles = data->triangles;
    }
    data->materials.push_back({.name = "default", .where = {}});
    return data;
}

}  // namespace

struct lancer_scene {
    PictureOptions options;
    Prepared prepared;
    std::unique_ptr<Renderer> renderer;  // null until the scene is read
    std::string warnings;

    void forget() { renderer.reset(), warnings.clear(), prepared = {}; }
    // Must be called inside with_threads.
    void read()
    {
        if (renderer) return;
        forget();
        Diagnostics diagnostics;
        prepared = load_prepared(options, diagnostics, true);
        begin_prepared(prepared, diagnostics);
        renderer = make_renderer(prepared, options, usual_batch, diagnostics);
        for (const std::string& w : prepared.warnings) warnings += w + '\n';
    }
    unsigned threads(unsigned asked) const { return asked > 0 ? asked : available_threads(); }
    void render(std::span<const lancer_layer> layers, const std::stop_token& stop,
                const std::function<void(double)>& report)
    {
        const RenderSettings& s = prepared.settings;
        const size_t pixels = size_t{s.size.width} * s.size.height;
        std::vector<Aov> aovs;
        for (const lancer_layer& l : layers) {
            const std::string name = l.name ? l.name : "";
            const size_t channels = lancer_layer_channels(name.c_str());
            if (channels == 0) fail_usage_of_api("there is no layer " + in_quotes(name));
            if (!l.values || l.count != pixels * channels)
                fail_usage_of_api("layer " + in_quotes(name) + " needs room for " + std::to_string(pixels * channels) +
                                  " numbers, not " + std::to_string(l.count));
            if (name != color_layer) aovs.push_back(*value_of<Aov>(name));
        }
        Film film(s.size.width, s.size.height, {0, 0, s.size.width, s.size.height});
        film.keep_aovs(layout_of(aovs));
        keep_for_settings(s, film);
        const Camera camera(prepared.description, renderer->scene().normalisation, film.width, film.height,
                            pixel_grid(s));
        if (!fill_film(*renderer, camera, film, s.spp, stop, report)) return;
        for (const lancer_layer& l : layers) copy(film, l);
    }
    void copy(const Film& film, const lancer_layer& layer) const
    {
        if (layer.name == color_layer) {
            for (size_t i = 0; i < film.pixels.size(); ++i) {
                const Color c = film.whole(i).mean();
                layer.values[3 * i] = c.r, layer.values[3 * i + 1] = c.g, layer.values[3 * i + 2] = c.b;
            }
            return;
        }
        const auto planes = aov_planes(film, {*value_of<Aov>(layer.name)}, renderer->scene().normalisation);
        for (size_t c = 0; c < planes.size(); ++c)
            for (size_t i = 0; i < film.pixels.size(); ++i) layer.values[planes.size() * i + c] = planes[c].values[i];
    }
};

const char* lancer_version(void)
{
    static const std::string number = version_number();
    return number.c_str();
}
int lancer_api_version(void) { return LANCER_API_VERSION; }
const char* lancer_error(void) { return last_error.c_str(); }

lancer_scene* lancer_scene_open(const char* file)
{
    try {
        auto scene = std::make_unique<lancer_scene>();
        scene->options.scene.file = file ? file : "";
        return scene.release();
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

lancer_scene* lancer_scene_from_text(const char* toml, const char* folder)
{
    try {
        auto scene = std::make_unique<lancer_scene>();
        scene->options.scene.text = toml ? toml : "";
        scene->options.scene.file = std::string(folder && *folder ? folder : ".") + "/scene.toml";
        return scene.release();
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

void lancer_scene_free(lancer_scene* scene) { delete scene; }

int lancer_scene_define(lancer_scene* scene, const char* definition)
{
    return guarded_apart([&] {
        if (!scene || !definition) fail_usage_of_api("a scene and a definition are needed");
        scene->options.scene.definitions.emplace_back(definition);
        scene->forget();
        return LANCER_OK;
    });
}

int lancer_scene_add_mesh(lancer_scene* scene, const lancer_mesh* mesh)
{
    return guarded_apart([&] {
        if (!scene || !mesh) fail_usage_of_api("a scene and a mesh are needed");
        MeshDescription made;
        made.name = mesh->name ? mesh->name : "";
        made.material = mesh->material ? mesh->material : "";
        made.data = data_of(*mesh);
        scene->options.scene.meshes.push_back(std::move(made));
        scene->forget();
        return LANCER_OK;
    });
}

int lancer_scene_size(lancer_scene* scene, uint32_t* width, uint32_t* height)
{
    return guarded_apart([&] {
        if (!scene || !width || !height) fail_usage_of_api("a scene and places for its size are needed");
        with_threads(scene->threads(0), [&] { scene->read(); });
        *width = scene->prepared.settings.size.width, *height = scene->prepared.settings.size.height;
        return LANCER_OK;
    });
}

const char* lancer_scene_warnings(const lancer_scene* scene) { return scene ? scene->warnings.c_str() : ""; }

size_t lancer_layer_channels(const char* name)
{
    if (!name) return 0;
    if (name == color_layer) return 3;
    const auto aov = value_of<Aov>(name);
    return aov ? channel_count(*aov) : 0;
}

int lancer_scene_render(lancer_scene* scene, const lancer_layer* layers, size_t layer_count, unsigned threads,
                        lancer_progress progress, void* user)
{
    return guarded_apart([&] {
        if (!scene || (!layers && layer_count > 0)) fail_usage_of_api("a scene and layers are needed");
        std::stop_source stop;
        std::mutex mutex;
        double latest = 0;
        const auto report = [&](double done) {
            const std::lock_guard lock(mutex);
            if (!progress || stop.stop_requested() || done <= latest) return;  // tiles end in any order
            latest = done;
            if (progress(user, done) != 0) stop.request_stop();
        };
        with_threads(scene->threads(threads), [&] {
            scene->read();
            scene->render({layers, layer_count}, stop.get_token(), report);
        });
        return stop.stop_requested() ? LANCER_CANCELLED : LANCER_OK;
    });
}
