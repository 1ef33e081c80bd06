// A scene that is so plain that eight of its places can be shaded at once: triangles drawn as they are, Lambert's
// materials, lit by triangles of one colour each or by a sky of one colour. What it lacks is never asked for:
// instances, spheres, media, and where it looks nothing up textures, maps and holes as well. Tables of it as registers
// want them.
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
    // Places that have these are looked at one by one; what follows is done for eight again.
    static constexpr Features looked_up{Feature::textures, Feature::bump_maps, Feature::normal_maps,
                                        Feature::vertex_colors, Feature::cut_outs};

    bool looks_up = false;        // whether it has any of those
    std::vector<Row> albedo;      // of each material, before anything is looked up
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
