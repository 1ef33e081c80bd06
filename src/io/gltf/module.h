// The C interface between the program and the module lancer_gltf, which alone is linked with meshoptimizer and Draco
// and is loaded only when a glTF file is compressed. No C++ types or exceptions cross it.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

struct LancerDracoMesh;  // decoded

struct LancerDracoInfo {
    uint32_t points, faces;
    char message[256];  // the reason, after a failure
};

enum LancerMeshoptMode : int32_t { lancer_meshopt_attributes, lancer_meshopt_triangles, lancer_meshopt_indices };
enum LancerMeshoptFilter : int32_t {
    lancer_meshopt_none,
    lancer_meshopt_octahedral,
    lancer_meshopt_quaternion,
    lancer_meshopt_exponential
};

// Changes with every change of this file: a module left over from another build is refused.
constexpr int32_t lancer_gltf_current_version = 1;

int32_t lancer_gltf_version();
// Into `destination`, which has room for count * stride bytes and 64 more. The caller has checked what the format says
// of count and stride. 0: what was compressed is broken.
int32_t lancer_gltf_meshopt(void* destination, size_t count, size_t stride, LancerMeshoptMode mode,
                            LancerMeshoptFilter filter, const void* bytes, size_t size);
// Null: see info->message.
LancerDracoMesh* lancer_gltf_draco_open(const void* bytes, size_t size, LancerDracoInfo* info);
// Three for each face.
void lancer_gltf_draco_indices(const LancerDracoMesh* mesh, uint32_t* indices);
// Of each point so many numbers of the attribute, as glTF's component type says. 0: there is no such attribute.
int32_t lancer_gltf_draco_attribute(const LancerDracoMesh* mesh, uint32_t id, uint32_t components,
                                    int32_t component_type, void* values);
void lancer_gltf_draco_close(LancerDracoMesh* mesh);
}
