#include "app/prepare.h"

#include "app/console.h"
#include "app/defaults/complete_scene.h"
#include "app/load_scene.h"
#include "app/picture_memory.h"
#include "app/system_info.h"
#include "core/parallel.h"
#include "scene/camera.h"
#include "scene/hidden_lights.h"

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

}  // namespace

Prepared load_prepared(const PictureOptions& options, Diagnostics& diagnostics, bool quiet)
{
    Prepared p;
    p.threads = options.threads.value_or(available_threads());
    p.memory = memory_for(options.memory, p.threads);
    p.images = std::make_unique<ImageSource>(p.threads, p.memory.ahead);
    serve(p.memory, *p.images);
    const auto begin_reading = [&p](const std::string& file) { return p.early.emplace_back(p.images->request(file)); };
    with_warnings(diagnostics, [&] {
        with_threads(p.threads, [&] { p.description = load_scene(options.scene, diagnostics, begin_reading); });
    });
    p.settings = resolve_settings(options.render, p.description.render);
    with_threads(p.threads, [&] {
        p.added =
            complete_scene(p.description, options.scene, aspect_of(p.settings.size), p.images->source(), p.memory);
    });
    if (!p.added.text.empty() && !quiet)
        print_note("added to the scene, as it says nothing about it; to change it, put this into a scene file:\n" +
                   p.added.text);
    return p;
}

void begin_prepared(Prepared& p, Diagnostics& diagnostics)
{
    with_warnings(diagnostics,
                  [&] { p.scene.emplace(p.description, p.settings, diagnostics, p.images->source(), p.memory); });
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
                                        Diagnostics& diagnostics, const std::function<void()>& accelerator_built)
{
    auto renderer = with_warnings(diagnostics, [&] {
        return std::make_unique<Renderer>(std::move(*p.scene), configure(p.settings, batch), diagnostics,
                                          accelerator_built);
    });
    const double begin = wall_seconds();
    p.hidden_lights = warn_of_hidden_lights(p.description, p.settings, *renderer, diagnostics);
    p.hidden_lights_s = wall_seconds() - begin;
    print_warnings(diagnostics);
    for (const auto& warning : diagnostics.warnings()) p.warnings.push_back(to_string(warning));
    if (options.strict && !p.warnings.empty())
        throw Error(ErrorKind::invalid_input, {options.scene.file},
                    std::to_string(p.warnings.size()) + " warnings, and --strict allows none");
    return renderer;
}

}  // namespace lancer
