// What a change of the sight rebuilds: nothing, a kernel, a scene, or its accelerator too.
#pragma once

#include <memory>

#include "app/view/sight.h"
#include "render/renderer.h"
#include "scene/build/scene_builder.h"

namespace lancer {

struct RebuildSetup {
    RasterSource images;
    PictureMemory memory;
    uint32_t batch = 256;  // as of RenderOptions
};

// The renderer of a sight, which takes over what it can of that of the sight before. Null: that one serves. A scene
// without extent is normalised by its camera. Throws Error. Must be called inside with_threads.
std::shared_ptr<const Renderer> renderer_for(const Sight& sight, const Sight& before, const Renderer& renderer,
                                             const RebuildSetup& setup);

}  // namespace lancer
