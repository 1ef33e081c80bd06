// The shading normal: interpolated, perturbed by a bump or normal map, then limited so that the mirror direction stays
// above the surface. Mikkelsen, "Surface Gradient-Based Bump Mapping Framework", JCGT 9(3), 2020.
#pragma once

#include <optional>

#include "core/lanes/vec.h"
#include "materials/traits.h"

namespace lancer {

// Unit tangents along u and v; not parallel, not necessarily orthogonal.
struct Tangents {
    Vec3 u, v;
    Vec2 unit{1, 1};  // length of a unit step in u and in v, units of the file
};

// What the three numbers of a map of normals are factors of.
struct TangentFrame {
    Vec3 x, y, z;
};

// Orthonormal: x along t.u, y towards t.v, z: ns. Nothing where u runs along ns.
std::optional<TangentFrame> frame_about(Vec3 ns, const Tangents& t);

// The direction of a surface's tangent in the local frame of a shading normal, as cosine and sine: along the x of the
// frame of its texture coordinates, where it has one, else an axis of the local frame.
Vec2 local_tangent(const std::optional<TangentFrame>& tangents, Vec3 ns);

// The perturbed normal. ns: unit, on the front side. point: uv and footprint. bump: along the texture coordinates of
// the bump map. frame: of the normal map; nothing leaves the normal as it is.
Vec3 mapped_normal(const MaterialTraits& traits, const ShadingPoint& point, const std::optional<Tangents>& bump,
                   const std::optional<TangentFrame>& frame, Vec3 ns);

// Mirror direction of wo about ns, and whether it is high enough above a surface of normal n: at least a hundredth, or
// almost as high as wo if that is lower, since a perfect mirror keeps its normal for every wo. T: float or a vector of
// them.
template <class T>
struct MirrorImage {
    Vec3T<T> to;
    T least, height;

    MirrorImage(const Vec3T<T>& n, const Vec3T<T>& ns, const Vec3T<T>& wo)
        : to(ns * (2.0f * dot(ns, wo)) - wo), least(smaller(0.9f * dot(n, wo), T{} + 0.01f)), height(dot(n, to))
    {
    }
    auto is_outside() const { return height >= least; }
};

// For specular surfaces: the normal nearest to ns, in the plane of ns and wo, whose mirror direction lies above the
// surface. Without it paths that hit a tilted facet would end. All vectors are unit; dot(n, wo) > 0, dot(ns, wo) >= 0.
Vec3 keep_reflection_outside(Vec3 n, Vec3 ns, Vec3 wo);

}  // namespace lancer
