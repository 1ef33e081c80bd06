// A scene made ready to render outside of the program: what the benches take their rays and pictures from.
#pragma once

#include <memory>
#include <string>

#include "app/bench/rays.h"
#include "app/options/options.h"
#include "app/options/settings.h"
#include "io/image/source.h"
#include "render/renderer.h"
#include "scene/camera.h"

namespace lancer::bench {

// The kinds of rays that the suite measures.
inline constexpr auto suite_kinds = std::to_array<std::string_view>({"primary", "shadow", "ao", "bounce1", "bounce2"});

class Stage {
public:
    // Throws Error, also for what is wrong with the pictures of the scene. Call inside with_threads.
    // command_line: what overrides [render] of the description.
    Stage(const SceneDescription& description, const RenderSettings& command_line);
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

private:
    Stage(const SceneDescription& description, const RenderSettings& resolved, std::unique_ptr<ImageSource> images);

public:
    const RenderSettings settings;
    const RendererConfig config;
    const Renderer renderer;
    const Scene& scene;
    const Camera camera;

    // The whole picture, in tiles as the program makes them.
    std::vector<Tile> tiles() const { return source().tiles(); }
    Film film() const { return {settings.size.width, settings.size.height, whole()}; }
    Tile whole() const { return source().whole(); }
    RaySource source() const { return {renderer, config.kernel, camera, settings.size}; }
    // The picture at so many samples per pixel.
    Film draw(uint32_t spp) const;
};

// A scene file or a mesh as the program would take it. Throws Error, also if it is not there.
SceneDescription load_description(const std::string& file, const RenderSettings& command_line = {});
// A mesh alone, whatever its materials grey and without holes, under a sky and a sun. Without a camera it is seen
// whole.
SceneDescription describe_mesh(const MeshData& mesh, const std::optional<CameraDescription>& camera = {});

// A scene of the project: "cornell" is scenes/cornell.toml.
std::string scene_file(const std::string& name);

}  // namespace lancer::bench
