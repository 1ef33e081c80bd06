// Builds the tables of a mesh for rendering, without unused entries.
#pragma once

#include "scene/scene.h"

namespace lancer {

// Sets shading.material and face_material: no table if all faces have the same material.
void set_materials(MeshShading& shading, std::span<const uint32_t> of_faces);

// Fills positions, triangles, normals, texture coordinates, tangents, linear vertex colours and alphas, transformed by
// `place`. The materials of shading must be set and have their traits.
void fill_tables(const MeshData& data, const Transform& place, const std::vector<Color>& colors,
                 const std::vector<float>& alphas, const std::vector<MaterialTraits>& traits, Mesh& mesh,
                 MeshShading& shading, UnusedFeatures& unused_features);

// Keeps normals as octahedral codes (RenderSettings::compact); those behind positions leave that place.
void pack_normals(Mesh& mesh, CornerNormals& normals);

// Frees texture coordinates that no material reads any more.
void drop_unread_uvs(Scene& scene);

}  // namespace lancer
