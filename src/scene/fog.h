// Fog: a medium that fills a box of the scene, or all of it, wherever no body is.
#pragma once

#include <algorithm>
#include <limits>

#include "core/vec.h"
#include "materials/medium.h"

namespace lancer {

// From near to far along a ray; nothing if near >= far.
struct Stretch {
    float near = 0, far = 0;
};

struct Fog {
    static constexpr float inf = std::numeric_limits<float>::infinity();
    uint16_t medium = no_medium;  // in Scene::media; none: there is no fog
    Vec3 low{-inf, -inf, -inf}, high{inf, inf, inf};

    // The part of a ray of length t in the box. dir: unit.
    Stretch along(Vec3 org, Vec3 dir, float t) const
    {
        Stretch s{0, t};
        const auto clip = [&](float from, float by, float lower, float upper) {
            if (by == 0) {
                if (from < lower || from > upper) s.far = 0;
                return;
            }
            const float a = (lower - from) / by, b = (upper - from) / by;
            s.near = std::max(s.near, std::min(a, b)), s.far = std::min(s.far, std::max(a, b));
        };
        clip(org.x, dir.x, low.x, high.x);
        clip(org.y, dir.y, low.y, high.y);
        clip(org.z, dir.z, low.z, high.z);
        return s;
    }
};

}  // namespace lancer
