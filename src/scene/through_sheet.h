// Shadow rays through thin sheets of smooth glass.
#pragma once

#include "core/color.h"
#include "core/ray.h"
#include "scene/surface.h"

namespace lancer {

struct Scene;

// The part of the light along a ray that goes straight on where the ray meets a thin sheet of smooth glass; black for
// all other surfaces.
Color through_sheet(const Scene& scene, const Ray& ray, const Surface& surface);

// Whether the scene has such sheets, and lights that only light sampling finds.
bool lights_pass_sheets(const Scene& scene);

}  // namespace lancer
