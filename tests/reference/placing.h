// Where things stand: a linear map by its rows and a displacement, from what scene files say (docs/scene-format.md).
#pragma once

#include "reference/vector.h"
#include "scene/description/description.h"

namespace reference {

inline Vec vec(lancer::Vec3d v) { return {v.x, v.y, v.z}; }
inline Vec vec(lancer::Vec3 v) { return {double{v.x}, double{v.y}, double{v.z}}; }
inline Rgb rgb(lancer::Color c) { return {double{c.r}, double{c.g}, double{c.b}}; }

struct Linear {
    Vec rows[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

    Vec operator()(Vec v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
    Vec column(int i) const
    {
        const auto pick = [i](Vec v) { return i == 0 ? v.x : i == 1 ? v.y : v.z; };
        return {pick(rows[0]), pick(rows[1]), pick(rows[2])};
    }
    // Of the transposed map: for a rotation the way back.
    Vec back(Vec v) const { return rows[0] * v.x + rows[1] * v.y + rows[2] * v.z; }
    double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }
    // A normal, of any length: by the map of cofactors, which is the inverse transposed times the determinant.
    Vec normal(Vec n) const
    {
        const Vec c{dot(cross(rows[1], rows[2]), n), dot(cross(rows[2], rows[0]), n), dot(cross(rows[0], rows[1]), n)};
        return determinant() < 0 ? -c : c;
    }
};
// First b, then a.
inline Linear operator*(const Linear& a, const Linear& b)
{
    Linear m;
    for (int i = 0; i < 3; ++i)
        m.rows[i] = {dot(a.rows[i], b.column(0)), dot(a.rows[i], b.column(1)), dot(a.rows[i], b.column(2))};
    return m;
}

// Right-handed turns about x, then y, then z, in degrees.
inline Linear rotation(Vec degrees)
{
    const auto c = [](double d) { return std::cos(d * pi / 180); };
    const auto s = [](double d) { return std::sin(d * pi / 180); };
    const Vec d = degrees;
    const Linear x{{{1, 0, 0}, {0, c(d.x), -s(d.x)}, {0, s(d.x), c(d.x)}}};
    const Linear y{{{c(d.y), 0, s(d.y)}, {0, 1, 0}, {-s(d.y), 0, c(d.y)}}};
    const Linear z{{{c(d.z), -s(d.z), 0}, {s(d.z), c(d.z), 0}, {0, 0, 1}}};
    return z * (y * x);
}

struct Placing {
    Linear linear;
    Vec shift;

    Placing() = default;
    Placing(const Linear& m, Vec by) : linear(m), shift(by) {}
    explicit Placing(const lancer::TransformDescription& t) : shift(vec(t.translate))
    {
        const Linear scale{{{t.scale.x, 0, 0}, {0, t.scale.y, 0}, {0, 0, t.scale.z}}};
        linear = rotation(vec(t.rotate_deg)) * scale;
    }
    Vec point(Vec p) const { return linear(p) + shift; }
};
// First b, then a.
inline Placing operator*(const Placing& a, const Placing& b) { return {a.linear * b.linear, a.point(b.shift)}; }

}  // namespace reference
