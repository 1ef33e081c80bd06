// Slabs: flat bodies of two parallel faces.
#pragma once

#include <optional>

#include "scene/build/welded_faces.h"

namespace lancer {

// Least distance of two parallel lines between which all points lie, seen along n. n: unit.
double least_width(std::span<const Vec3d> points, Vec3d n);

struct SplitSlab {
    std::vector<uint32_t> front, rest;  // faces of one side; those of the other and the edges
};
// Nothing if the faces are not those of a slab thinner than `thinnest` times its smaller extent, with outward normals.
// body: numbers of faces that bound a volume.
std::optional<SplitSlab> split_slab(const WeldedFaces& faces, std::span<const uint32_t> body, double thinnest);

// Of open faces that lie in a plane.
struct FlatFaces {
    Vec3d n, center;  // unit; of the area
    double area = 0, width = 0;
};
// Nothing if they do not.
std::optional<FlatFaces> as_flat(const WeldedFaces& faces, std::span<const uint32_t> part);
// Whether the two are the sides of a slab without edges, no thicker than `thinnest` times its smaller extent.
bool are_sides_of_slab(const FlatFaces& a, const FlatFaces& b, double thinnest);

}  // namespace lancer
