// A scene that is so plain that eight of its places can be shaded at once: triangles drawn as they are, Lambert's
// materials of one colour each, lit by triangles of one colour each or by a sky of one colour. What it lacks is never
// asked for: textures, tilted normals, instances, spheres, holes, media. Tables of it as registers want them.
#pragma once

#include <optional>
#include <vector>

#include "core/vec_lanes.h"
#include "scene/features.h"
#include "scene/scene.h"

namespace lancer {

struct DiffuseScene {
    struct alignas(16) Row {
        float x = 0, y = 0, z = 0, w = 0;
    };
    // A triangle that shines.
    struct Light {
        Row a, b, c;      // its corners
        Row n_area;       // normal of its front side, and area
        Row front, back;  // radiance to either side; front.w: probability of being chosen
    };

    // What it may have; and of lamps and a sky only one.
    static constexpr Features features{Feature::vertex_normals, Feature::lambert, Feature::triangle_lights,
                                       Feature::constant_sky, Feature::light_tree};

    std::vector<Row> albedo;      // of each material
    std::vector<uint8_t> shines;  // of each material, whether any of its sides does
    std::vector<Light> lights;    // parallel to Scene::lights, if these are what is sampled

    // Nothing if the scene is not so plain.
    static std::optional<DiffuseScene> of(const Scene& scene);
};

inline RowLanes turned(const std::array<const DiffuseScene::Row*, float_lanes>& rows)
{
    return turned_rows([&](size_t i) { return load4(&rows[i]->x); });
}

}  // namespace lancer
