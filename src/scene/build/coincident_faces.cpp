#include "scene/build/coincident_faces.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace lancer {
namespace {

using Corners = WeldedFaces::Corners;

constexpr double flat_quad = 1e-3;  // how far the fourth corner of a quad may lie from the plane of the others, over
                                    // its longest edge: files round coordinates

Corners sorted(Corners c)
{
    std::sort(c.begin(), c.end());
    return c;
}
// Whether two orders of the same three corners go round in opposite directions.
bool are_reversed(const Corners& a, const Corners& b)
{
    const auto at = static_cast<size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
    return b[(at + 1) % 3] != a[1];
}

// Two faces that share an edge and form a flat quad.
struct Quad {
    std::array<uint32_t, 4> corners;  // ascending
    uint32_t group, low, high;        // the diagonal
    uint32_t a, b;                    // faces
};

uint32_t third_corner(const Corners& c, const FaceAtEdge& e) { return c[0] ^ c[1] ^ c[2] ^ e.low ^ e.high; }

// Whether the two faces at an edge lie side by side in a plane.
bool are_side_by_side(const WeldedFaces& faces, const FaceAtEdge& first, const FaceAtEdge& second)
{
    const Vec3d n = faces.normal(first.face), o = faces.positions[first.low];
    const Vec3d edge = faces.positions[first.high] - o;
    const Vec3d p = faces.positions[third_corner(faces.corners[first.face], first)] - o;
    const Vec3d q = faces.positions[third_corner(faces.corners[second.face], second)] - o;
    const double size = std::sqrt(std::max({dot(edge, edge), dot(p, p), dot(q, q)}));
    if (!(std::abs(dot(n, q)) <= flat_quad * size * length(n))) return false;
    const Vec3d across = cross(n, edge);
    return (dot(across, p) > 0) != (dot(across, q) > 0);
}

std::vector<Quad> quads_of(const WeldedFaces& faces, std::span<const uint32_t> group, const CoincidentFaces& found)
{
    constexpr size_t most_at_edge = 16;  // more are no quads of panes
    std::vector<Quad> quads;
    for_each_edge(edges_of(faces, [&](uint32_t f) { return found.stands(f); }), [&](std::span<const FaceAtEdge> at) {
        if (at.size() > most_at_edge) return;
        for (size_t i = 0; i < at.size(); ++i)
            for (size_t j = i + 1; j < at.size(); ++j) {
                if (group[at[i].face] != group[at[j].face] || !are_side_by_side(faces, at[i], at[j])) continue;
                std::array<uint32_t, 4> corners{at[i].low, at[i].high, third_corner(faces.corners[at[i].face], at[i]),
                                                third_corner(faces.corners[at[j].face], at[j])};
                std::sort(corners.begin(), corners.end());
                quads.push_back({corners, group[at[i].face], at[i].low, at[i].high, at[i].face, at[j].face});
            }
    });
    std::sort(quads.begin(), quads.end(), [](const Quad& x, const Quad& y) {
        return std::tie(x.group, x.corners, x.a, x.b) < std::tie(y.group, y.corners, y.a, y.b);
    });
    return quads;
}

}  // namespace

CoincidentFaces find_coincident(const WeldedFaces& faces, std::span<const uint32_t> group)
{
    const auto n = static_cast<uint32_t>(faces.size());
    CoincidentFaces found;
    found.first.resize(n), found.is_reversed.resize(n), found.back.resize(n, CoincidentFaces::none);
    found.half.resize(n, CoincidentFaces::none);
    std::vector<uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    std::vector<Corners> key(n);
    for (uint32_t f = 0; f < n; ++f) key[f] = sorted(faces.corners[f]);
    const auto place = [&](uint32_t f) { return std::tie(group[f], key[f]); };
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
    const auto join = [&](uint32_t face, uint32_t first, bool reversed) {
        found.first[face] = first, found.is_reversed[face] = reversed;
        if (face == first) return;
        found.any_ = true;
        if (reversed && found.back[first] == CoincidentFaces::none) found.back[first] = face;
    };
    for (size_t i = 0; i < n; ++i) {
        const uint32_t f = order[i];
        const uint32_t first = i > 0 && place(order[i - 1]) == place(f) ? found.first[order[i - 1]] : f;
        join(f, first, are_reversed(faces.corners[f], faces.corners[first]));
    }

    // Two quads of the same corners have different diagonals, as of equal triangles only one is here.
    const std::vector<Quad> quads = quads_of(faces, group, found);
    std::vector<uint32_t> moved(n, CoincidentFaces::none);  // of faces that stood for others, the one that now does
    bool any_moved = false;
    for (size_t i = 1; i < quads.size(); ++i) {
        const Quad &q = quads[i - 1], &r = quads[i];
        if (q.group != r.group || q.corners != r.corners || (q.low == r.low && q.high == r.high)) continue;
        const auto is_taken = [&](uint32_t f) { return moved[f] != CoincidentFaces::none; };
        if (is_taken(q.a) || is_taken(q.b) || is_taken(r.a) || is_taken(r.b)) continue;
        moved[q.a] = q.a, moved[q.b] = q.b, moved[r.a] = q.a, moved[r.b] = q.b;
        for (const Quad* quad : {&q, &r}) found.half[quad->a] = quad->b, found.half[quad->b] = quad->a;
        any_moved = true;
    }
    if (!any_moved) return found;
    std::vector<bool> turned(n);
    for (uint32_t f = 0; f < n; ++f)
        if (found.stands(f) && moved[f] != CoincidentFaces::none && moved[f] != f)
            turned[f] = dot(faces.normal(f), faces.normal(moved[f])) < 0;
    for (uint32_t f = 0; f < n; ++f) {
        const uint32_t before = found.first[f];
        if (moved[before] == CoincidentFaces::none || moved[before] == before) continue;
        join(f, moved[before], found.is_reversed[f] != turned[before]);
    }
    return found;
}

}  // namespace lancer
