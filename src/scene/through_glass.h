// Shadow rays through smooth glass.
#pragma once

#include "core/color.h"
#include "core/ray.h"
#include "scene/surface.h"

namespace lancer {

struct Scene;

// The part of the light along a ray that goes straight on where the ray meets a thin sheet of smooth glass, and with
// Scene::straight_shadows the boundary of any smooth glass; black for all other surfaces.
Color through_glass(const Scene& scene, const Ray& ray, const Surface& surface);

// Whether the scene has such surfaces, and lights that only light sampling finds.
bool lights_pass_glass(const Scene& scene);

}  // namespace lancer
