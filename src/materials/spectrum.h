// Colours of one point and of four, and functions for both: formulas of materials that are templates over T = float and
// T = Float4.
#pragma once

#include <type_traits>

#include "core/color.h"
#include "core/lanes/vec.h"

namespace lancer {

template <class T>
using SpectrumOf = std::conditional_t<std::is_same_v<T, float>, Color, Vec3T<T>>;
// What is looked up for each point.
template <class T, class Row>
using RowsOf = std::conditional_t<std::is_same_v<T, float>, Row, std::array<Row, 4>>;

inline Color product(Color a, Color b) { return a * b; }
inline Vec3T<Float4> product(const Vec3T<Float4>& a, const Vec3T<Float4>& b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline void set_lane(Vec3T<Float4>& colors, size_t i, Color c)
{
    colors.x[i] = c.r, colors.y[i] = c.g, colors.z[i] = c.b;
}
inline float largest(Color c) { return max_component(c); }
inline Float4 largest(const Vec3T<Float4>& c) { return larger(c.x, larger(c.y, c.z)); }
inline Float4 mix(Float4 a, Float4 b, Float4 t) { return a + (b - a) * t; }
inline Vec3T<Float4> mix(const Vec3T<Float4>& a, const Vec3T<Float4>& b, Float4 t) { return a + (b - a) * t; }
inline Color select(bool m, Color yes, Color no) { return m ? yes : no; }
template <class Spectrum, class F>
Spectrum each(const Spectrum& color, const F& f)
{
    const auto& [r, g, b] = color;
    return {f(r), f(g), f(b)};
}
template <class Mask>
bool any_lane(Mask m)
{
    return movemask(m) != 0;
}

}  // namespace lancer
