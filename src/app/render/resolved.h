// What a render is asked for, once the scene, the command line and the defaults have had their say.
#pragma once

#include "app/frame_cache.h"
#include "app/options/options.h"
#include "app/prepare.h"
#include "scene/description/description.h"

namespace lancer {

struct ResolvedRender {
    RenderOptions options;  // denoise: also if the scene asks for it
    Prepared prepared;
    RenderSettings settings;
    Tile crop;                 // of the picture; without --crop all of it
    OutputDescription output;  // of the scene, and over it of the command line
};

// Loads the scene and writes it again where --write-scene asks for it: before the render, which may take long or be
// interrupted. film: of the frames before, or null. Throws Error for what does not fit together.
ResolvedRender resolve_render(const RenderOptions& options, Diagnostics& diagnostics, FrameCache* film);

}  // namespace lancer
