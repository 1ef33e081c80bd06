// The stochastic alpha test: a surface of opacity a stops a ray with probability a. Cut-outs, gauze and half-
// transparent panes therefore need no rays of their own; accelerators call the test at each hit of a marked primitive
// (AlphaTest in geometry/geometry.h).
#pragma once

#include <cstdint>

#include "materials/textures/texture.h"

namespace lancer {

struct Scene;

// Sets geometry.alpha_test if any material of the scene has an opacity below 1. Must be called before an accelerator is
// built and when the scene has its final address, as the geometry then refers to it. Opacity textures may be loaded
// later.
void bind_alpha_test(Scene& scene);

// Alpha of the vertex colours at a point of a triangle, by which its opacity is multiplied; 1 if the mesh has none.
float vertex_alpha(const Scene& scene, uint32_t mesh, uint32_t triangle, Vec2 uv);

// Opacity of a surface at a point, in [0, 1], from the texture's finest level. Light sampling evaluates it for
// emitters, as a shadow ray ends before the light's own surface.
float opacity_at(const Scene& scene, uint32_t material, const ShadingPoint& point);

}  // namespace lancer
