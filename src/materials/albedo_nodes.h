// The cosines at which tables of albedos have values, and between which of them one lies. There are few leading bits in
// a node, four nodes per power of two, as losses vary with cos / alpha near grazing and with cos elsewhere. Below the
// first node its values are used.
// Where light meets what is thinner, the reflectance has an edge: all of it at the critical angle, and a root less
// beyond. Facets smear it by as much as they are rough. Such a table has the same nodes three times, and most of them
// where something happens: from grazing to half of the critical cosine, from there towards it, and from it on.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/lanes/lanes.h"

namespace lancer {

inline constexpr uint32_t bits_below_node = 21;
inline constexpr float least_cos = 0x1p-12f;
inline constexpr uint32_t plain_cosines = 49, edged_cosines = 3 * plain_cosines;

// Between a node and the next one. T: float or Float4.
template <class T>
struct NodeCellT {
    decltype(to_whole(T{})) index;
    T part;
};
using NodeCell = NodeCellT<float>;

constexpr float node_from(float least, uint32_t i)
{
    return std::bit_cast<float>(std::bit_cast<uint32_t>(least) + (i << bits_below_node));
}
// As std::clamp().
inline float clamped(float x, float least, float most) { return std::clamp(x, least, most); }
inline Float4 clamped(Float4 x, float least, float most) { return max(min(x, Float4{} + most), Float4{} + least); }
template <class T>
NodeCellT<T> cell_from(T x, float least, uint32_t nodes)
{
    const auto offset = bits_of(clamped(x, least, 1)) - std::bit_cast<uint32_t>(least);
    const auto index = min(offset >> bits_below_node, decltype(offset){} + (nodes - 2));
    const T rest = to_float(as_signed(offset - (index << bits_below_node)));
    return {index, rest * (1.0f / (uint32_t{1} << bits_below_node))};
}

// A cosine of a table with an edge: in which of the three pieces, and how far it is in [0, 1] from where most nodes
// are: from grazing, from the edge below it, from the edge above it.
struct EdgedCosine {
    uint32_t piece;
    float from;
};
// edge: the critical cosine, in (0, 1); 0: there is none, and one piece.
constexpr uint32_t pieces_of(float edge) { return edge > 0 ? 3 : 1; }
inline EdgedCosine edged_cosine(float edge, float cos)
{
    if (!(edge > 0)) return {0, cos};
    const float half = 0.5f * edge;
    if (cos <= half) return {0, cos / half};
    if (cos < edge) return {1, (edge - cos) / half};
    return {2, (cos - edge) / (1 - edge)};
}
// edge: above 0.
constexpr float cosine_of(float edge, EdgedCosine c)
{
    const float half = 0.5f * edge;
    return c.piece == 0 ? half * c.from : c.piece == 1 ? edge - half * c.from : edge + (1 - edge) * c.from;
}

constexpr uint32_t cosines_of(float edge) { return edge > 0 ? edged_cosines : plain_cosines; }

// Node i, ascending.
constexpr float cosine_node(float edge, uint32_t i)
{
    if (!(edge > 0)) return node_from(least_cos, i);
    const uint32_t piece = i / plain_cosines, k = i % plain_cosines;
    return cosine_of(edge, {piece, node_from(least_cos, piece == 1 ? plain_cosines - 1 - k : k)});
}
inline NodeCell edged_cell(float edge, float cos)
{
    const auto [piece, from] = edged_cosine(edge, cos);
    if (piece > 0 && from < least_cos) {  // between the two nodes next to the edge
        constexpr uint32_t last = 2 * plain_cosines - 1;
        const float low = cosine_node(edge, last), high = cosine_node(edge, last + 1);
        return {last, std::clamp((cos - low) / (high - low), 0.0f, 1.0f)};
    }
    const NodeCell c = cell_from(from, least_cos, plain_cosines);
    if (piece == 1) return {2 * plain_cosines - 2 - c.index, 1 - c.part};
    return {piece * plain_cosines + c.index, c.part};
}
inline NodeCell cosine_cell(float edge, float cos)
{
    return edge > 0 ? edged_cell(edge, cos) : cell_from(cos, least_cos, plain_cosines);
}

// Between which of so many even steps in [0, 1] a number lies.
template <class T>
NodeCellT<T> even_cell(T x, uint32_t nodes)
{
    const T at = clamped(x, 0, 1) * static_cast<float>(nodes - 1);
    const auto index = to_whole(smaller(at, T{} + static_cast<float>(nodes - 2)));
    return {index, at - to_float(as_signed(index))};
}

// Two neighbouring values of a table, and two of its next row.
template <class T>
struct TableSquare {
    T a, b, c, d;

    // part: of the way to the second of two neighbours; row: of the way to the next row.
    T at(T part, T row) const
    {
        const T low = a + part * (b - a), high = c + part * (d - c);
        return low + row * (high - low);
    }
};
// columns: how far rows are from each other.
inline TableSquare<float> table_square(const float* at, size_t columns)
{
    return {at[0], at[1], at[columns], at[columns + 1]};
}
inline TableSquare<Float4> table_square(const std::array<const float*, 4>& at, size_t columns)
{
    const auto one = [&](size_t i) { return load2x2(at[i], at[i] + columns); };
    const auto [a, b, c, d] = transpose4x4(std::array<Float4, 4>{one(0), one(1), one(2), one(3)});
    return {a, b, c, d};
}

// Tables whose values vary with the root of the cosine have even steps of it, the first one near grazing.
inline double root_node(uint32_t i, uint32_t count) { return std::max(2e-3, static_cast<double>(i) / (count - 1)); }
template <class T>
NodeCellT<T> root_cell(T cos, uint32_t count)
{
    return even_cell(sqrt(larger(T{}, cos)), count);
}

// Where fixed quadratures over visible normals have their heights, in (0, 1), and how much each counts: denser towards
// both ends, as the few strongly tilted normals lose most.
template <class T>
struct HeightNode {
    T at, weight;
};
template <class T>
HeightNode<T> height_node(size_t i, size_t count)
{
    const T s = (static_cast<T>(i) + T{0.5f}) / static_cast<T>(count);
    return {s * s * (3 - 2 * s), s * (1 - s)};
}

}  // namespace lancer
