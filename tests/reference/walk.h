// One camera ray's light, by a random walk that only surfaces steer.
#pragma once

#include "reference/surface.h"

namespace reference {

struct WalkSettings {
    uint32_t max_depth = 0;  // surface vertices that scatter; 0: no limit
    bool indirect = true;    // else only light that comes straight to the first surface which spreads it
};

// Kajiya, "The Rendering Equation", SIGGRAPH 1986, without sampling of lights; but those that no ray meets, points and
// directions, are all asked at every surface that spreads light.
Rgb walk(const World& world, Ray ray, const WalkSettings& settings, Random& random);

}  // namespace reference
