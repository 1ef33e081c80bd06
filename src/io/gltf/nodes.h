// What the default scene of a glTF file places where.
#pragma once

#include <array>
#include <optional>
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

// As nodes and instances state it: scale first, then rotation by a quaternion x, y, z, w, then translation. Nothing if
// the quaternion cannot be normalised.
struct GltfParts {
    std::array<double, 3> translation{};
    std::array<double, 4> rotation{0, 0, 0, 1};
    std::array<double, 3> scale{1, 1, 1};
};
std::optional<Transform> transform_of(const GltfParts& parts);

// Follows the nodes of the default scene; of a file without scenes all nodes, without nodes all meshes. Throws Error
// for nodes that are their own children or have two parents, and for transforms that are no finite affine maps.
GltfScene read_gltf_nodes(GltfDocument& document);

}  // namespace lancer
