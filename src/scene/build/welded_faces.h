// Some faces of a mesh with corners that are the same vertex where their positions are the same, for questions about
// the shape that they form: find_sheets() asks them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/transform.h"
#include "scene/description/description.h"

namespace lancer {

struct WeldedFaces {
    using Corners = std::array<uint32_t, 3>;

    std::vector<uint32_t> number;  // of each face, in the mesh; ascending
    std::vector<Corners> corners;  // welded vertices, counter-clockwise seen from the side that rendering takes for the
                                   // front: vertex normals decide it before the winding does
    std::vector<Vec3d> positions;  // of the welded vertices, scene units

    size_t size() const { return corners.size(); }
    // Twice the area along the normal.
    Vec3d normal(size_t face) const
    {
        const auto& [a, b, c] = corners[face];
        return cross(positions[b] - positions[a], positions[c] - positions[a]);
    }
};

// A face at one of its edges, from vertex `low` to vertex `high` of a greater number.
struct FaceAtEdge {
    uint32_t low, high, face;
    bool forward;  // the face has them in this order

    bool is_of_same_edge(const FaceAtEdge& o) const { return low == o.low && high == o.high; }
};
void sort_by_edge(std::vector<FaceAtEdge>& edges);
// All edges of the faces for which is_meant(face), the faces of each edge one after the other, by their number.
template <class F>
std::vector<FaceAtEdge> edges_of(const WeldedFaces& faces, const F& is_meant)
{
    std::vector<FaceAtEdge> edges;
    edges.reserve(3 * faces.size());
    for (uint32_t f = 0; f < faces.size(); ++f) {
        if (!is_meant(f)) continue;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = faces.corners[f][k], b = faces.corners[f][(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), f, a < b});
        }
    }
    sort_by_edge(edges);
    return edges;
}
// f(faces) for each edge, with the span of all that meet there.
template <class F>
void for_each_edge(std::span<const FaceAtEdge> edges, const F& f)
{
    for (size_t i = 0, end; i < edges.size(); i = end) {
        for (end = i + 1; end < edges.size() && edges[end].is_of_same_edge(edges[i]);) ++end;
        f(edges.subspan(i, end - i));
    }
}

// which: numbers of triangles of the mesh, ascending; those without an area are left out. place: from the mesh to the
// scene. Vertices at open edges are also welded where rounding has separated them.
WeldedFaces weld_faces(const MeshData& data, const Transform& place, std::span<const uint32_t> which);

}  // namespace lancer
