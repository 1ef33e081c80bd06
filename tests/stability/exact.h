// Where lines meet shapes, in long double and by the plainest formulas: what rows compare with.
#pragma once

#include <array>
#include <cmath>

#include "geometry/geometry.h"

namespace lancer::stability {

using Real = long double;
using RealVec = std::array<Real, 3>;

template <class T>
RealVec real(Vec3T<T> v)
{
    return {Real{v.x}, Real{v.y}, Real{v.z}};
}
inline RealVec minus(const RealVec& a, const RealVec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Real inner(const RealVec& a, const RealVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Of float, at x.
inline double ulp(double x) { return std::ldexp(1.0, std::max(-126, x == 0 ? -126 : std::ilogb(x)) - 23); }
inline double ulps_between(double a, double b) { return std::abs(a - b) / ulp(b); }

struct Roots {
    Real discriminant;  // over r^2: 1 through the centre, 0 tangent, negative: no crossing
    Real t0, t1;        // in order
};
inline Roots roots(const Sphere& s, const Ray& ray)
{
    const RealVec o = minus(real(ray.org), real(s.center)), d = real(ray.dir);
    const Real a = inner(d, d), b = -inner(o, d), r = s.radius;
    const RealVec nearest{o[0] + d[0] * b / a, o[1] + d[1] * b / a, o[2] + d[2] * b / a};
    const Real discriminant = r * r - inner(nearest, nearest), root = std::sqrt(std::max(Real{0}, a * discriminant));
    const Real q = b + (b < 0 ? -root : root), distance = std::sqrt(inner(o, o));
    const Real t0 = (distance - r) * (distance + r) / q, t1 = q / a;
    return {discriminant / (r * r), std::min(t0, t1), std::max(t0, t1)};
}

// Distance to the plane of a triangle of a mesh that is drawn as it is.
inline double triangle_t(const Geometry& g, const Ray& ray, const Hit& hit)
{
    const Mesh& m = g.meshes[hit.geometry];
    const auto& t = m.triangles[hit.primitive];
    const RealVec a = real(m.positions[t[0]]);
    const RealVec u = minus(real(m.positions[t[1]]), a), v = minus(real(m.positions[t[2]]), a);
    const RealVec n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    return static_cast<double>(inner(n, minus(a, real(ray.org))) / inner(n, real(ray.dir)));
}

}  // namespace lancer::stability
