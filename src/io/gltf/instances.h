// The places of a mesh that a node lists in accessors instead of in nodes of their own: Khronos Group, glTF extension
// EXT_mesh_gpu_instancing. Ten million nodes as JSON take gigabytes to parse.
#pragma once

#include <optional>
#include <vector>

#include "core/transform.h"
#include "io/gltf/buffers.h"

namespace lancer {

// From the space of the mesh to that of the node, in the order of the accessors; nothing if the node lists none. Throws
// Error if accessors have other types or different counts, or hold what is no finite transform.
std::optional<std::vector<Transform>> read_gltf_instances(const JsonValue& node, GltfDocument& document,
                                                          GltfBuffers& buffers);

}  // namespace lancer
