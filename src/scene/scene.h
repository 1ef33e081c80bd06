// The scene as rendered: arrays and ids, in normalised units. Built once, const ever after.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/bounds.h"
#include "core/error.h"
#include "geometry/geometry.h"
#include "materials/material.h"
#include "scene/description.h"
#include "scene/light.h"
#include "scene/placement.h"

namespace lancer {

// What shading needs to know of a mesh, beside its geometry.
struct MeshShading {
    std::vector<Vec3> normals;                              // unit; empty if the mesh is flat
    std::vector<std::array<uint32_t, 3>> normal_triangles;  // per triangle, MeshData::no_normal where it is flat
    std::vector<uint32_t> face_material;                    // per triangle; empty if the mesh has one material
    uint32_t material = 0;
    std::vector<uint32_t>
        emitter_rank;  // per triangle: its place among the mesh's emitters, or none; empty if it has none

    uint32_t material_of(uint32_t triangle) const { return face_material.empty() ? material : face_material[triangle]; }
};

struct Scene {
    static constexpr uint32_t none = UINT32_MAX;

    Geometry geometry;
    std::vector<MeshShading> shading;  // parallel to geometry.meshes
    std::vector<uint32_t> sphere_material, plane_material;

    std::vector<Material> materials;
    std::vector<Emission> emission;  // parallel to materials
    std::vector<std::string> material_names;

    LightTable lights;
    std::vector<uint32_t> mesh_first_light, instance_first_light, sphere_light;  // ids in lights, or none
    uint32_t environment_light = none;
    Color environment{};  // radiance of what no ray hits

    Normalisation normalisation;
    Bounds bounds;  // of all but planes and giant spheres, scene units

    // Checks what only the whole scene can tell, resolves names, normalises, lists the lights. Problems go to
    // diagnostics; throws Error if there are any.
    static Scene build(const SceneDescription& description, Diagnostics& diagnostics);

    uint64_t triangle_count() const;  // instances not multiplied
};

}  // namespace lancer
