// How much the lamps of a scene light a view, beside the light that a sky would bring: what decides whether a bare mesh
// needs a sky.
#pragma once

#include "render/renderer.h"
#include "scene/description/description.h"

namespace lancer {

// Of the surfaces that are seen and do not emit.
struct OwnLight {
    double open = 1;   // mean part of an even sky whose light would reach them straight or through glass, in [0, 1]
    double lit = 0;    // part of them to which lamps bring at least a quarter of the light of such a sky, of radiance 1
    double level = 0;  // median radiance by the lamps of a white surface in their place
};

// The scene must have no sky. From a small picture with 32 samples a pixel. Must be called inside with_threads.
OwnLight measure_own_light(const Renderer& renderer, const CameraDescription& view, PictureSize size);

}  // namespace lancer
