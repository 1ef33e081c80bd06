// Orthonormal basis around a unit vector, without branches or singularities.
// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
#pragma once

#include "core/vec.h"

namespace lancer {

struct Frame {
    Vec3 x, y, z;

    // n: unit. z is n itself.
    explicit Frame(Vec3 n) : z(n)
    {
        const float s = std::copysign(1.0f, n.z);
        const float a = -1 / (s + n.z);
        const float b = n.x * n.y * a;
        x = {1 + s * n.x * n.x * a, s * b, -s * n.x};
        y = {b, s + n.y * n.y * a, -n.y};
    }
    Vec3 to_local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
    Vec3 to_world(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace lancer
