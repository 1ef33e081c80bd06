// The light of a bare mesh: a sky, a key light that goes with the view, and a ground. complete_scene() calls it.
#pragma once

#include <string>

#include "app/defaults/default_view.h"
#include "app/load_scene.h"
#include "scene/build/picture_memory.h"
#include "scene/description/description.h"

namespace lancer {

struct DefaultLight {
    std::string text;  // of the scene file, that adds the same; with a comment that says why, or why nothing was added
    std::string note;  // the comment alone, on one line
};

// Adds light to a bare mesh, unless the scene has some (by -D or --env) or its own emitting faces light the view: they
// have to light a third of what is seen at least a quarter as much as the sky would, which must not reach it freely.
// The scene must have its camera, which `view` tells of. aspect: of the picture, width over height. pictures: asked for
// those of emission where faces emit, and for --env; memory: what they may take. Must be called inside with_threads.
DefaultLight add_default_light(SceneDescription& scene, const SceneChoice& choice, const DefaultView& view,
                               double aspect, const RasterSource& pictures, const PictureMemory& memory);

}  // namespace lancer
