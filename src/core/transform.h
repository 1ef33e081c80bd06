// Affine map in double: linear part by columns, then a translation.
#pragma once

#include "core/vec.h"

namespace lancer {

struct Transform {
    Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, translation{};

    Vec3d vector(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
    Vec3d point(Vec3d p) const { return vector(p) + translation; }
    // A normal n of a surface becomes M^-T n. Called on the inverse of M; the length is not kept.
    Vec3d normal_by_inverse(Vec3d n) const { return {dot(x, n), dot(y, n), dot(z, n)}; }
    double determinant() const { return dot(cross(x, y), z); }

    friend bool operator==(const Transform&, const Transform&) = default;
};

inline bool is_finite(const Transform& m)
{
    return is_finite(m.x) && is_finite(m.y) && is_finite(m.z) && is_finite(m.translation);
}

// First b, then a.
inline Transform compose(const Transform& a, const Transform& b)
{
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.translation)};
}

// The determinant must not be 0.
inline Transform inverse(const Transform& m)
{
    const double d = m.determinant();
    const Vec3d r0 = cross(m.y, m.z) / d, r1 = cross(m.z, m.x) / d, r2 = cross(m.x, m.y) / d;  // rows of the inverse
    Transform i{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {}};
    i.translation = -i.vector(m.translation);
    return i;
}

// Scale, then turn about x, then y, then z (degrees, right-handed), then translate.
inline Transform make_transform(Vec3d translate, Vec3d rotate_deg, Vec3d scale)
{
    // Multiples of 90 degrees are exact, so that a quarter turn keeps every bit of a coordinate.
    const auto sin_cos = [](double deg, double& s, double& c) {
        const double turn = std::remainder(deg, 360.0), quarter = turn / 90.0;
        if (quarter == std::nearbyint(quarter)) {
            const int q = (static_cast<int>(quarter) + 4) % 4;
            s = q == 1 ? 1 : q == 3 ? -1 : 0;
            c = q == 0 ? 1 : q == 2 ? -1 : 0;
        } else {
            const double rad = turn * (pi_d / 180.0);
            s = std::sin(rad);
            c = std::cos(rad);
        }
    };
    double sx, cx, sy, cy, sz, cz;
    sin_cos(rotate_deg.x, sx, cx);
    sin_cos(rotate_deg.y, sy, cy);
    sin_cos(rotate_deg.z, sz, cz);
    const Transform rx{{1, 0, 0}, {0, cx, sx}, {0, -sx, cx}, {}};
    const Transform ry{{cy, 0, -sy}, {0, 1, 0}, {sy, 0, cy}, {}};
    const Transform rz{{cz, sz, 0}, {-sz, cz, 0}, {0, 0, 1}, {}};
    Transform m = compose(rz, compose(ry, rx));
    return {m.x * scale.x, m.y * scale.y, m.z * scale.z, translate};
}

}  // namespace lancer
