// A large flat mirror. A lamp in front of it lights what it faces as a second lamp behind it would: light sampling
// finds that image, where BSDF sampling has to hit the lamp by chance.
#pragma once

#include "core/vec.h"

namespace lancer {

// The mirror image of a direction; n: the mirror's unit normal, on either side.
inline Vec3 mirror_image(Vec3 w, Vec3 n) { return w - n * (2 * dot(w, n)); }

struct PlanarMirror {
    Vec3 p, n;  // a point of its plane, scene units, and the plane's unit normal, on either side
    Vec3 u, v;  // unit, span the plane
    // Bounds of its triangles along u and v, from p, scene units.
    Vec2 low, high;

    // Mirror image of a direction.
    Vec3 image_of(Vec3 w) const { return mirror_image(w, n); }
    // Mirror image of a place.
    Vec3 image_at(Vec3 q) const { return q - n * (2 * dot(q - p, n)); }
    // Whether a ray crosses the plane within the bounds, between its origin and t_max.
    bool is_crossed(Vec3 org, Vec3 dir, float t_max) const
    {
        const float t = dot(p - org, n) / dot(dir, n);
        if (!(t > 0 && t < t_max)) return false;
        const Vec3 at = org + dir * t - p;
        const float x = dot(at, u), y = dot(at, v);
        return x >= low.x && x <= high.x && y >= low.y && y <= high.y;
    }
};

}  // namespace lancer
