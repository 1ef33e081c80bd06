// Orthonormal basis around a unit vector, without branches or singularities.
// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
#pragma once

#include "core/lanes/lanes.h"
#include "core/vec.h"

namespace lancer {

template <class T>
struct FrameT {
    Vec3T<T> x, y, z;

    // n: unit. z is n itself.
    explicit FrameT(Vec3T<T> n) : z(n)
    {
        const T s = copysign(T{} + 1.0f, n.z);
        const T a = -1.0f / (s + n.z);
        const T b = n.x * n.y * a;
        x = {1.0f + s * n.x * n.x * a, s * b, -s * n.x};
        y = {b, s + n.y * n.y * a, -n.y};
    }
    Vec3T<T> to_local(Vec3T<T> v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
    Vec3T<T> to_world(Vec3T<T> v) const { return x * v.x + y * v.y + z * v.z; }
};
using Frame = FrameT<float>;

}  // namespace lancer
