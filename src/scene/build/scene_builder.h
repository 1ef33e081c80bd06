// A scene while it is built. Everything but what pictures decide is there at once; an accelerator can be built of the
// geometry while the pictures are still being read.
#pragma once

#include <memory>

#include "scene/build/picture_memory.h"
#include "scene/scene.h"

namespace lancer {

class SceneBuilder {
public:
    // See Scene::begin(). memory: what `images` may take.
    SceneBuilder(const SceneDescription& description, const RenderSettings& settings, Diagnostics& diagnostics,
                 const RasterSource& images, PictureMemory memory = {});

    // Complete. It stays where it is, and is the geometry of the scene that finish() returns.
    const Geometry& geometry() const { return scene_->geometry; }
    // Whether something besides a sky of one colour may send out light; pictures may turn out to be black.
    bool may_have_emitters() const;
    // For checks of what was described: without lights and the environment, and its textures stand for 1.
    const Scene& unfinished() const { return *scene_; }
    const PendingPictures& pending() const { return pending_; }

    // Waits for the pictures, makes the textures and lists the lights. A picture that could not be read gives a
    // warning, and its texture is 1; an environment or background that could not be read throws Error, as the picture
    // would be black. Pictures that would take too much memory are an Error (no_memory) before they are read. Must be
    // called once.
    std::unique_ptr<const Scene> finish(Diagnostics& diagnostics);

private:
    friend struct Scene;
    void complete(Diagnostics& diagnostics);
    Scene finish_by_value(Diagnostics& diagnostics);

    std::unique_ptr<Scene> scene_;
    PendingPictures pending_;
    PictureMemory memory_;
    uint32_t texture_limit_;  // as in RenderSettings
};

}  // namespace lancer
