// What the default scene of a glTF file places where.
#pragma once

#include <vector>

#include "core/transform.h"
#include "io/gltf/document.h"

namespace lancer {

struct GltfPlaced {
    const JsonValue* node = nullptr;  // null: of a file without nodes
    const JsonValue* what = nullptr;
    Transform to_world{};
};

struct GltfScene {
    std::vector<GltfPlaced> meshes, cameras, lights;  // in the order of the nodes, parents first
};

// Follows the nodes of the default scene; of a file without scenes all nodes, without nodes all meshes. Throws Error
// for nodes that are their own children or have two parents, and for transforms that are no finite affine maps.
GltfScene read_gltf_nodes(GltfDocument& document);

}  // namespace lancer
