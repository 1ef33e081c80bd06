// Which faces of a mesh file without vertex normals get some, and up to which edge.
#pragma once

namespace lancer {

struct Smoothing {
    enum class Faces {
        none,    // all faces are flat
        groups,  // those of smoothing groups
        all,     // those of smoothing groups; where a file names no group, all of its faces
    };
    Faces faces = Faces::groups;
    double largest_deg = 70;  // faces that meet at a larger angle, between their normals, stay an edge

    friend auto operator<=>(const Smoothing&, const Smoothing&) = default;
};

}  // namespace lancer
