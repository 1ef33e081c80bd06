// What a pilot found out about a scene: how paths split, where light is sampled, which parts of the sky.
#pragma once

#include "render/renderer.h"

namespace lancer {

// Prints the sampling plan of a picture of this size. map: a PNG that gets, for each pixel, the rate of light sampling
// where its camera ray meets a surface, from 0 to 1, black where it meets none; empty: none is written. Must be called
// inside with_threads. Throws Error (failed) if it cannot be written.
void print_plan(const Renderer& renderer, const CameraDescription& camera, PictureSize size, const std::string& map);

}  // namespace lancer
