// The tables of a mesh as rendering keeps them: without what no triangle refers to and no material reads.
#pragma once

#include "scene/scene.h"

namespace lancer {

// The faces of shading.material and face_material: one material instead of a table where all have the same.
void set_materials(MeshShading& shading, std::span<const uint32_t> of_faces);

// Positions, triangles, normals, texture coordinates, colours (of the vertices, linear), moved by `place`. The
// materials of shading must be set and have their traits.
void fill_tables(const MeshData& data, const Transform& place, const std::vector<Color>& colors,
                 const std::vector<MaterialTraits>& traits, Mesh& mesh, MeshShading& shading,
                 UnusedFeatures& unused_features);

// Lets go of texture coordinates that nothing reads any more.
void drop_unread_uvs(Scene& scene);

}  // namespace lancer
