#include "app/prepare.h"

#include <algorithm>
#include <tuple>

#include "app/console.h"
#include "app/defaults/complete_scene.h"
#include "app/load_scene.h"
#include "app/picture_memory.h"
#include "app/system_info.h"
#include "core/parallel.h"
#include "scene/camera.h"
#include "scene/hidden_lights.h"
#include "scene/placement.h"
#include "scene/view/turntable.h"

namespace lancer {
namespace {

void print_warnings(const Diagnostics& diagnostics)
{
    for (const auto& warning : diagnostics.warnings()) print_problem(to_string(warning));
}

// Warnings are printed even if errors follow, as they often explain them.
template <class F>
auto with_warnings(const Diagnostics& diagnostics, F&& f)
{
    try {
        return f();
    } catch (...) {
        print_warnings(diagnostics);
        throw;
    }
}

// --turntable: about the middle of what there is to see, or what the camera looks at.
void turn_camera(Prepared& p, const SceneChoice& choice)
{
    p.metered = *p.description.camera;
    if (choice.turntable == 0) return;
    SceneDescription without_lamps = p.description;
    without_lamps.lights.clear();
    const Bounds subject = subject_bounds(without_lamps);
    CameraDescription& camera = *p.description.camera;
    camera = turned(camera, subject.empty() ? camera.target : subject.center(), p.added.up,
                    static_cast<double>(choice.frame.value_or(0)) / choice.turntable);
}

// The way of the camera while the shutter is open, unless an option has put another one in its place.
void complete_camera_path(SceneDescription& d, const SceneChoice& choice)
{
    for (const CamerasAtTime& then : d.cameras_later) {
        std::optional<CameraDescription> camera = then.own;
        const auto named = std::find_if(then.named.begin(), then.named.end(), [&](const CameraDescription& c) {
            return choice.camera.empty() || c.name == choice.camera;
        });
        if (named != then.named.end() && (!choice.camera.empty() || !camera)) camera = *named;
        if (!camera) break;
        // What the file leaves out stays as it was found.
        if (camera->missing.target) camera->target = d.camera->target;
        if (camera->missing.fov) camera->fov_deg = d.camera->fov_deg;
        if (camera->missing.up || choice.up) camera->up = d.camera->up;
        d.camera_path.push_back(*camera);
    }
    const auto is_seen_alike = [](const CameraDescription& a, const CameraDescription& b) {
        return std::tie(a.position, a.target, a.up, a.fov_deg, a.aperture, a.focus) ==
               std::tie(b.position, b.target, b.up, b.fov_deg, b.aperture, b.focus);
    };
    const bool stands_still = std::all_of(d.camera_path.begin(), d.camera_path.end(), [&](const CameraDescription& c) {
        return is_seen_alike(c, d.camera_path.front());
    });
    if (stands_still || !is_seen_alike(d.camera_path.front(), *d.camera)) d.camera_path.clear();
}

// Tells of lights that a renderer's integrator cannot find, and of everything else that was found before.
void report_scene(Prepared& p, const Renderer& renderer, Diagnostics& diagnostics)
{
    const double begin = wall_seconds();
    p.hidden_lights = warn_of_hidden_lights(p.description, p.settings, renderer, diagnostics);
    p.hidden_lights_s = wall_seconds() - begin;
    print_warnings(diagnostics);
    for (const auto& warning : diagnostics.warnings()) p.warnings.push_back(to_string(warning));
}

}  // namespace

Prepared load_prepared(const PictureOptions& options, Diagnostics& diagnostics, bool quiet, FrameCache* film)
{
    Prepared p;
    p.threads = options.threads.value_or(available_threads());
    p.memory = memory_for(options.memory, p.threads);
    const bool is_first = !film || !film->images;
    p.images = is_first ? std::make_shared<ImageSource>(p.threads, p.memory.ahead) : film->images;
    p.pictures = film ? film->held(p.images->source()) : p.images->source();
    if (film) film->images = p.images;
    serve(p.memory, *p.images);
    if (film && film->unturned) {
        std::tie(p.description, p.added) = *film->unturned;
        p.settings = resolve_settings(options.render, p.description.render);
        turn_camera(p, options.scene);
        return p;
    }
    const auto begin_reading = [&p](const std::string& file) { return p.early.emplace_back(p.pictures(file)); };
    with_warnings(diagnostics, [&] {
        with_threads(p.threads, [&] {
            p.description = load_scene(options.scene, diagnostics, begin_reading, film, film && is_first);
        });
    });
    p.settings = resolve_settings(options.render, p.description.render);
    with_threads(p.threads, [&] {
        p.added = complete_scene(p.description, options.scene, aspect_of(p.settings.size), p.pictures, p.memory);
    });
    if (film && options.scene.turntable) film->unturned.emplace(p.description, p.added);
    turn_camera(p, options.scene);
    complete_camera_path(p.description, options.scene);
    if (!p.added.text.empty() && !quiet)
        print_note("added to the scene, as it says nothing about it; to change it, put this into a scene file:\n" +
                   p.added.text);
    return p;
}

void begin_prepared(Prepared& p, Diagnostics& diagnostics)
{
    with_warnings(diagnostics, [&] { p.scene.emplace(p.description, p.settings, diagnostics, p.pictures, p.memory); });
    p.early.clear();  // what the scene did not ask for again it does not use
}

uint32_t warn_of_hidden_lights(const SceneDescription& description, const RenderSettings& settings,
                               const Renderer& renderer, Diagnostics& diagnostics)
{
    const bool samples_lights =
        settings.integrator == IntegratorKind::path || settings.integrator == IntegratorKind::direct;
    if (!samples_lights || !settings.nee || settings.legacy) return 0;
    const Scene& scene = renderer.scene();
    const Camera camera(*description.camera, scene.normalisation, settings.size.width, settings.size.height);
    return warn_of_hidden_lights(description, scene, renderer.accelerator(), camera, settings.size, diagnostics);
}

std::unique_ptr<Renderer> make_renderer(Prepared& p, const PictureOptions& options, uint32_t batch,
                                        Diagnostics& diagnostics, const std::function<void()>& accelerator_built,
                                        const Renderer* before)
{
    auto renderer = with_warnings(diagnostics, [&] {
        return std::make_unique<Renderer>(std::move(*p.scene), configure(p.settings, batch), diagnostics,
                                          accelerator_built, before);
    });
    report_scene(p, *renderer, diagnostics);
    if (options.strict && !p.warnings.empty())
        throw Error(ErrorKind::invalid_input, {options.scene.file},
                    std::to_string(p.warnings.size()) + " warnings, and --strict allows none");
    return renderer;
}

bool is_same_scene(const FrameCache& film, const Prepared& p)
{
    // The units of a scene without extent follow its camera.
    return film.renderer && film.still_hash == p.description.still_hash && film.added == p.added.text &&
           subject_bounds(p.description).extent() > 0;
}

std::shared_ptr<const Renderer> renderer_of_film(const FrameCache& film, Prepared& p, Diagnostics& diagnostics)
{
    report_scene(p, *film.renderer, diagnostics);
    return film.renderer;
}

void keep_for_film(FrameCache& film, const Prepared& p, std::shared_ptr<const Renderer> renderer)
{
    film.renderer = std::move(renderer);
    film.still_hash = p.description.still_hash;
    film.added = p.added.text;
    // A scene that stays as it is asks for no picture again.
    if (!p.description.animation || p.description.animation->moves_views_only) film.pictures.clear();
}

}  // namespace lancer
