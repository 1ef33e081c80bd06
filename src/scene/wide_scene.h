// A scene of which eight places can be shaded at once: without media. Plainest are triangles of Lambert's materials
// drawn as they are, lit by triangles of one colour each or by a sky of one colour: what such a scene lacks is never
// asked for. Else places are looked at one by one, lights that are no such triangles sampled so, and materials that are
// not Lambert's asked so. Tables of it as registers want them.
#pragma once

#include <optional>
#include <vector>

#include "core/lanes/row_table.h"
#include "scene/features.h"
#include "scene/flat_table.h"
#include "scene/scene.h"

namespace lancer {

enum class Shading {
    plain,     // nothing is looked up
    textured,  // matt places that may have textures, maps and holes, under any lights
    any,       // of any material
};

struct WideScene {
    // What is said of one place, gathered for eight without a branch: said << i is ORed for place i, after which byte k
    // has the places of which the k-th fact is true.
    struct LaneFlags {
        uint32_t bits = 0;
        void add(uint32_t i, uint32_t flags) { bits |= flags << i; }
        uint32_t lanes(uint32_t flag) const { return bits / flag & 255; }
    };
    // Of triangles.
    static constexpr uint32_t is_drawn = 1, is_straight = 1u << 8, is_fixed = 1u << 16,  // no map tilts it; Fixed::is
        is_mirroring = 1u << 24;                                                         // MaterialTraits::mirrors
    // Of BSDFs.
    static constexpr uint32_t is_non_lambert = 1, is_plastic = 1u << 8, is_only_delta = 1u << 16,
                              is_transmissive = 1u << 24;

    // A triangle that shines: its corners, behind the first PointOnTriangle::rounding(); normal of its front side, and
    // area; radiance to either side, behind that of the front the probability of being chosen.
    enum LightRow : size_t { corner_a, corner_b, corner_c, normal_area, front, back, light_rows };
    // A sphere that shines.
    struct alignas(32) SphereLightRow {
        std::array<double, 4> center_radius{};
        Row radiance;        // of its outside; w: probability of being chosen
        float rounding = 0;  // rounding_on()
    };
    // How a light is sampled.
    enum class LightKind : uint8_t {
        triangle,  // drawn as it is and of one colour
        sphere,    // of one colour
        constant_environment,
        other,  // by the functions for one
    };

    // What each way of shading knows, and those above it. Of lamps and a sky the plainest knows only one at a time.
    static constexpr Features plain{Feature::vertex_normals, Feature::lambert, Feature::triangle_lights,
                                    Feature::constant_sky, Feature::light_tree};
    static constexpr Features textured{Feature::spheres,        Feature::planes,
                                       Feature::instances,      Feature::textures,
                                       Feature::bump_maps,      Feature::normal_maps,
                                       Feature::vertex_colors,  Feature::cut_outs,
                                       Feature::point_lights,   Feature::directional_lights,
                                       Feature::sphere_lights,  Feature::shaped_triangle_lights,
                                       Feature::sky_map,        Feature::background,
                                       Feature::textured_lights};
    static constexpr Features any{Feature::mirror,  Feature::metal,     Feature::glass,
                                  Feature::plastic, Feature::interface, Feature::mixes};

    // What a material becomes wherever it is, on the back and on the front of a surface.
    struct Fixed {
        bool is = false;  // if not, it asks for the place
        std::array<AnyBsdf, 2> bsdf{};
        std::array<uint32_t, 2> flags{};  // bsdf_flags() these
    };

    Shading shading = Shading::plain;           // the least that it takes
    RowTable<1> albedo;                         // of each material, before anything is looked up
    FlatTable flat;                             // only where the plainest way of shading will do
    std::vector<uint8_t> shines;                // of each material, whether any of its sides does
    std::vector<uint32_t> triangle_flags;       // of each material, facts of triangles of it that are drawn as they are
    std::vector<Fixed> fixed;                   // of each material; not where the plainest way of shading will do
    bool has_colors = false;                    // of vertices
    std::vector<LightKind> light_kinds;         // parallel to Scene::lights
    RowTable<light_rows> lights;                // so, too, if some are triangles
    std::vector<SphereLightRow> sphere_lights;  // so, too, if some are balls
    bool has_triangles_only = false;            // of the lights

    // Nothing if the scene is not so plain.
    static std::optional<WideScene> of(const Scene& scene);
};

// What there is to know of a BSDF besides what it is asked: whether it is not Lambert's, whether it is plastic, has
// only delta lobes, lets light through.
template <Bsdf B>
uint32_t bsdf_flags(const B& bsdf)
{
    if constexpr (std::is_same_v<B, LambertBsdf>) return 0;
    return WideScene::is_non_lambert | (std::is_same_v<B, PlasticBsdf> ? WideScene::is_plastic : 0) |
           (bsdf.only_delta() ? WideScene::is_only_delta : 0) | (bsdf.transmits() ? WideScene::is_transmissive : 0);
}

}  // namespace lancer
