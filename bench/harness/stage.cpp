#include "harness/stage.h"

#include "app/load_scene.h"

namespace lancer::bench {
namespace {

Renderer renderer_of(const SceneDescription& description, const Settings& settings, const RenderSettings& render,
                     const RasterSource& images)
{
    Diagnostics diagnostics;
    SceneDescription said = description;
    // Where Scene::begin looks for them.
    for (size_t i = 0; i < switch_names.size(); ++i)
        said.render.set(static_cast<Switch>(i), settings.switches[static_cast<Switch>(i)]);
    return Renderer(Scene::begin(said, diagnostics, images), render, diagnostics);
}

}  // namespace

Stage::Stage(const SceneDescription& description, const PictureOptions& options)
    : Stage(description, resolve_settings(options, description.render), std::make_unique<ImageSource>(1))
{
}

Stage::Stage(const SceneDescription& description, const Settings& s, std::unique_ptr<ImageSource> images)
    : settings(s),
      render(to_render_settings(settings, RenderOptions{}.batch)),
      renderer(renderer_of(description, settings, render, images->source())),
      scene(renderer.scene()),
      camera(description.camera.value(), scene.normalisation, settings.width, settings.height, settings.grid)
{
}

Film Stage::draw(uint32_t spp) const
{
    Film drawn = film();
    renderer.pass(camera, drawn, tiles(), {0, spp});
    return drawn;
}

SceneDescription load_description(const std::string& file, const PictureOptions& options)
{
    Diagnostics diagnostics;
    SceneDescription d = load_scene({.file = file, .asset_root = {}, .definitions = {}, .camera = {}}, diagnostics);
    const Settings s = resolve_settings(options, d.render);
    complete_scene(d, double(s.width) / s.height);
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
