// How much of a part of a mesh is open.
#pragma once

#include <unordered_map>

#include "scene/build/coincident_faces.h"

namespace lancer {

// Area of the holes over that of the faces; of a hole that is not flat that of its widest shadow. A face that is turned
// counts as a hole around it. edges: of the part, sorted as edges_of() does; part: its faces, without copies.
double open_part(const WeldedFaces& faces, const CoincidentFaces& copies, std::span<const FaceAtEdge> edges,
                 std::span<const uint32_t> part);

// Edges of all faces of a mesh but those in question.
class OtherEdges {
public:
    // is_other: of a triangle of the mesh, whether it is not in question. place: as of `faces`.
    template <class F>
    OtherEdges(const MeshData& data, const Transform& place, const WeldedFaces& faces, const F& is_other)
    {
        const std::vector<uint32_t> vertex = vertices_of(data, place, faces);
        const bool mirrors = place.determinant() < 0;
        for (uint32_t t = 0; t < data.triangles.size(); ++t)
            if (is_other(t)) add(data.triangles[t], vertex, mirrors);
    }
    // Whether faces go on at each open edge, in the direction that closes it. edges: as of open_part().
    bool close(std::span<const FaceAtEdge> edges) const;

private:
    // The welded vertex in the place of each vertex of the mesh, or none.
    static std::vector<uint32_t> vertices_of(const MeshData& data, const Transform& place, const WeldedFaces& faces);
    void add(const WeldedFaces::Corners& triangle, const std::vector<uint32_t>& vertex, bool mirrors);

    std::unordered_map<uint64_t, int> turns_;  // of each edge, the sum of the directions in which faces have it
};

}  // namespace lancer
