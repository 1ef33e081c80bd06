// A scene made ready to render outside of the program: what the benches take their rays and pictures from.
#pragma once

#include <memory>
#include <string>

#include "app/settings.h"
#include "render/renderer.h"
#include "scene/camera.h"

namespace lancer::bench {

// Built once; does not move, as accelerators point into it.
struct Stage {
    Settings settings;
    Scene scene;
    Camera camera;
    RenderSettings render;

    Stage(const SceneDescription& description, const PictureOptions& options);
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

private:
    Stage(const SceneDescription& description, Settings s);
};

// A scene file or a mesh as the program would take it. Throws Error, also if it is not there.
SceneDescription load_description(const std::string& file, const PictureOptions& options = {});
// A mesh alone, whatever its materials grey and without holes, under a sky and a sun. Without a camera it is seen
// whole.
SceneDescription describe_mesh(const MeshData& mesh, const std::optional<CameraDescription>& camera = {});

// A scene of the project: "cornell" is scenes/cornell.toml.
std::string scene_file(const std::string& name);

}  // namespace lancer::bench
