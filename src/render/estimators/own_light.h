// How much the lamps of a scene light a view, beside the light that a sky would bring: what decides whether a bare mesh
// needs a sky.
#pragma once

#include "render/renderer.h"
#include "scene/description/description.h"

namespace lancer {

// Of the surfaces that are seen and do not emit.
struct OwnLight {
    double open = 1;   // mean part of a constant sky whose light would reach them straight or through glass, in [0, 1]
    double lit = 0;    // part of them to which lamps bring at least a quarter of the light of such a sky
    double level = 0;  // median radiance by the lamps of a white surface in their place, over that of the sky
};

// sky: its radiance, > 0; the scene itself must have none. From a small picture with 32 samples a pixel. Must be called
// inside with_threads.
OwnLight measure_own_light(const Renderer& renderer, const CameraDescription& view, PictureSize size, double sky);

}  // namespace lancer
