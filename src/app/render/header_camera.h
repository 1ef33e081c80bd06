// The camera of a picture, as attributes of its EXR header.
#pragma once

#include "io/image/exr.h"
#include "scene/camera.h"

namespace lancer {

// From the units of the scene file. width, height: of the whole picture, in pixels. Of a thin lens: the ray through its
// centre.
ExrCamera header_camera(const Camera& camera, const Normalisation& normalisation, uint32_t width, uint32_t height);

}  // namespace lancer
