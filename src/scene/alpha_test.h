// What surfaces with holes do to rays: a surface of opacity a stops a ray with probability a, so cut-outs, gauze and
// half-transparent panes need no more than the hits that accelerators ask about (Holes, in geometry/geometry.h).
#pragma once

#include <cstdint>

#include "materials/textures/texture.h"

namespace lancer {

struct Scene;

// Has the accelerators of this scene ask which hits let rays pass, if any of its materials has holes. Call it before
// one is built, and when the scene stands where it stays: the geometry then refers to it. Opacity textures may arrive
// later.
void bind_alpha_test(Scene& scene);

// The part of the rays that a surface stops at a place, in [0, 1], always of the texture's finest level. Light sampling
// asks it of emitters, as a shadow ray ends before the light's own surface.
float opacity_at(const Scene& scene, uint32_t material, const ShadingPoint& point);

}  // namespace lancer
