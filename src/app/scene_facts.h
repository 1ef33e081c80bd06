// What lancer info tells of a scene, counted once, as numbers and names: for text and for JSON.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/bounds.h"
#include "geometry/accel.h"
#include "scene/description/description.h"
#include "scene/scene.h"

namespace lancer {

struct SceneFacts {
    struct Reason {
        std::string name, type, why;  // of a material of an OBJ file, and what decided it
    };
    struct ImageSize {
        uint32_t width = 0, height = 0;
        uint64_t bytes = 0;
    };
    struct Bytes {
        uint64_t geometry = 0, shading = 0, textures = 0, lights = 0, accelerator = 0;
    };

    std::string file;
    uint64_t triangles = 0, drawn = 0, vertices = 0;
    // Meshes, triangles, pyramids, instances, spheres, bubbles, planes, planes of water.
    std::array<uint64_t, 8> shapes{};
    Bounds bounds{};
    std::map<std::string, uint64_t> materials, lights;  // how many of each type
    std::vector<Reason> reasons;
    std::vector<std::string> sheets, divisions;
    std::vector<ImageSize> images;
    uint64_t other_textures = 0, emitting_triangles = 0;
    std::string sky, ground;  // empty where there is no background
    bool has_glow = false;
    bool has_unnamed_camera = false;
    std::vector<std::string> cameras, features;
    Bytes bytes{};
};

// One and several of SceneFacts::shapes.
inline constexpr std::array<std::array<const char*, 2>, 8> shape_names{{{"mesh", "meshes"},
                                                                        {"triangle", "triangles"},
                                                                        {"pyramid", "pyramids"},
                                                                        {"instance", "instances"},
                                                                        {"sphere", "spheres"},
                                                                        {"bubble", "bubbles"},
                                                                        {"plane", "planes"},
                                                                        {"plane of water", "planes of water"}}};

SceneFacts facts_of(const SceneDescription& description, const Scene& scene, const Accelerator& accelerator);

}  // namespace lancer
