// The scenes of scenes/, for tests that compute with them.
#pragma once

#include "io/image/source.h"
#include "io/obj/obj.h"
#include "io/scene/scene_file.h"

namespace lancer {

// name: without folder of all scenes and without ".toml". With a camera. Throws if the scene is not sound.
inline SceneDescription shipped_scene(const std::string& name)
{
    Diagnostics diagnostics;
    SceneDescription d =
        load_scene_file(LANCER_SOURCE_DIR "/scenes/" + name + ".toml", {.mesh_loader = load_obj}, diagnostics);
    diagnostics.throw_if_errors();
    if (!d.camera) d.camera = d.cameras.at(0);
    return d;
}

}  // namespace lancer
