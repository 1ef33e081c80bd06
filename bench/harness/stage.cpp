#include "harness/stage.h"

#include "app/defaults/complete_scene.h"
#include "app/load_scene.h"
#include "core/parallel.h"

namespace lancer::bench {
namespace {

Renderer renderer_of(const SceneDescription& description, const RenderSettings& settings, const RendererConfig& config,
                     const RasterSource& images)
{
    Diagnostics diagnostics;
    return Renderer(Scene::begin(description, settings, diagnostics, images), config, diagnostics);
}

}  // namespace

Stage::Stage(const SceneDescription& description, const RenderSettings& command_line)
    : Stage(description, resolve_settings(command_line, description.render), std::make_unique<ImageSource>(1))
{
}

Stage::Stage(const SceneDescription& description, const RenderSettings& resolved, std::unique_ptr<ImageSource> images)
    : settings(resolved),
      config(configure(settings, RenderOptions{}.batch)),
      renderer(renderer_of(description, settings, config, images->source())),
      scene(renderer.scene()),
      camera(description.camera.value(), scene.normalisation, settings.size.width, settings.size.height,
             pixel_grid(settings))
{
}

Film Stage::draw(uint32_t spp) const
{
    Film drawn = film();
    renderer.pass(camera, drawn, tiles(), {0, spp});
    return drawn;
}

SceneDescription load_description(const std::string& file, const RenderSettings& command_line)
{
    Diagnostics diagnostics;
    const SceneChoice choice{.file = file, .asset_root = {}, .definitions = {}, .camera = {}, .smoothing = {}};
    SceneDescription d = load_scene(choice, diagnostics);
    const double aspect = aspect_of(resolve_settings(command_line, d.render).size);
    with_threads(available_threads(), [&] {
        ImageSource images(available_threads());
        complete_scene(d, choice, aspect, images.source(), {});
    });
    return d;
}

SceneDescription describe_mesh(const MeshData& mesh, const std::optional<CameraDescription>& camera)
{
    MeshData bare;
    bare.positions = mesh.positions, bare.triangles = mesh.triangles;
    bare.materials.emplace_back();
    SceneDescription d;
    d.meshes.emplace_back().data = std::make_shared<const MeshData>(std::move(bare));
    const Bounds subject = subject_bounds(d);
    d.camera = camera.value_or(fit_camera(subject, 4.0 / 3));
    LightDescription sky, sun;
    sky.type = LightType::environment, sky.power = {1, 1, 1};
    sun.type = LightType::directional, sun.power = {3, 3, 3}, sun.direction = {0.5, -1, -0.6};
    d.lights = {sky, sun};
    return d;
}

std::string scene_file(const std::string& name) { return LANCER_SOURCE_DIR "/scenes/" + name + ".toml"; }

}  // namespace lancer::bench
