// Vectors of eight and of four lanes: the operations of core/vec.h, with the same bits in each lane.
#pragma once

#include "core/lanes/lanes.h"
#include "core/vec.h"

namespace lancer {

using Vec3x8 = Vec3T<Float8>;
struct Vec2x8 {
    Float8 x, y;
};

inline Vec3x8 broadcast(Vec3 v) { return {broadcast(v.x), broadcast(v.y), broadcast(v.z)}; }
inline Float8 length(const Vec3x8& a) { return sqrt(dot(a, a)); }
inline Vec3x8 normalize(const Vec3x8& a) { return a * (1.0f / length(a)); }
inline Double4 length(const Vec3T<Double4>& a) { return sqrt(dot(a, a)); }
inline Vec3T<Double4> normalize(const Vec3T<Double4>& a) { return a * (1.0 / length(a)); }
inline Vec3x8 abs(const Vec3x8& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
inline Vec3x8 select(Mask8 m, const Vec3x8& yes, const Vec3x8& no)
{
    return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}
inline Vec3x8 permute(const Vec3x8& v, UInt8 from)
{
    return {permute(v.x, from), permute(v.y, from), permute(v.z, from)};
}
inline Vec3T<Float4> abs(const Vec3T<Float4>& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
inline Vec3T<Float4> select(Mask4f m, const Vec3T<Float4>& yes, const Vec3T<Float4>& no)
{
    return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}
inline Vec3 select(bool m, const Vec3& yes, const Vec3& no) { return m ? yes : no; }
template <class T>
Vec3T<T> broadcast_to(Vec3 v)
{
    return {broadcast_to<T>(v.x), broadcast_to<T>(v.y), broadcast_to<T>(v.z)};
}
// Component-wise product.
inline Vec3x8 times(const Vec3x8& a, const Vec3x8& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Mask8 is_black(const Vec3x8& c)
{
    const Float8 zero{};
    return (c.x == zero) & (c.y == zero) & (c.z == zero);
}
inline Vec3 lane(const Vec3x8& v, size_t i) { return {v.x[i], v.y[i], v.z[i]}; }
inline void set_lane(Vec3x8& v, size_t i, Vec3 to) { v.x[i] = to.x, v.y[i] = to.y, v.z[i] = to.z; }

inline Vec3T<Double4> in_four_lanes(Vec3d v) { return {broadcast(v.x), broadcast(v.y), broadcast(v.z)}; }
inline Vec3T<Double4> to_double(const Vec3T<Float4>& v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
inline Vec3T<Float4> to_float(const Vec3T<Double4>& v) { return {to_float(v.x), to_float(v.y), to_float(v.z)}; }
inline Vec3T<Float4> lower(const Vec3x8& v) { return {lower(v.x), lower(v.y), lower(v.z)}; }
inline Vec3T<Float4> upper(const Vec3x8& v) { return {upper(v.x), upper(v.y), upper(v.z)}; }
inline Vec3x8 concat(const Vec3T<Float4>& low, const Vec3T<Float4>& high)
{
    return {concat(low.x, high.x), concat(low.y, high.y), concat(low.z, high.z)};
}

// Transposes eight rows of four floats: each column becomes a register.
struct RowLanes {
    Vec3x8 xyz;
    Float8 w;
};
// row(i): row i.
template <class Row>
RowLanes transpose(const Row& row)
{
    const auto pair = [&](size_t i) { return concat(row(i), row(i + 4)); };
    const auto [x, y, z, w] = transpose4x4(std::array<Float8, 4>{pair(0), pair(1), pair(2), pair(3)});
    return {{x, y, z}, w};
}

// The same for four rows of four doubles.
struct RowsOfFour {
    Vec3T<Double4> xyz;
    Double4 w;
};
template <class Row>
RowsOfFour transpose4(const Row& row)
{
    const auto [x, y, z, w] = transpose4x4(std::array<Double4, 4>{row(0), row(1), row(2), row(3)});
    return {{x, y, z}, w};
}

}  // namespace lancer
