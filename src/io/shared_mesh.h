// A mesh that a file places several times.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/transform.h"
#include "scene/description/description.h"

namespace lancer {

struct SharedMesh {
    std::string name;  // no two of a file have the same
    std::shared_ptr<const MeshData> data;
    std::vector<TransformDescription> places;
};

// Scale, rotation and translation that give the map, to 12 digits; nothing if none do, as where it shears.
std::optional<TransformDescription> parts_of(const Transform& map);

}  // namespace lancer
