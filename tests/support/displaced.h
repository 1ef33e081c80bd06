// Meshes that are divided and displaced, as tests and benchmarks use them.
#pragma once

#include "scene/build/divide_meshes.h"
#include "support/images.h"
#include "support/scenes/scenes.h"

namespace lancer {

// A cube of six sides with vertices, texture coordinates and normals of their own: every edge is a seam.
MeshData seamed_cube(const MaterialDescription& material);
// A cube whose corners were moved onto the unit sphere, divided `rounds` times, each place once, with smooth normals.
MeshData displaceable_ball(uint32_t rounds, const MaterialDescription& material);

// picture: of heights.
MaterialDescription displaced_by(const std::string& picture, float scale);
inline SubdivisionDescription level(uint32_t n) { return {.is_asked = true, .edge_pixels = 0, .level = n}; }
inline SubdivisionDescription edges_of(double pixels) { return {.is_asked = true, .edge_pixels = pixels, .level = {}}; }
// The mesh with that material, seen from a distance of 6.
SceneDescription displaced_scene(MeshData data, const MaterialDescription& material, SubdivisionDescription how);
// The mesh of such a scene when it is divided and displaced.
MeshData divided_mesh(const SceneDescription& d, const RasterSource& pictures, const PictureMemory& memory = {});

}  // namespace lancer
