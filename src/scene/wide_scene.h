// Tables for shading eight points at once (the wide kernel), for scenes without media. The plainest variant supports
// non-instanced Lambertian triangles without textures, lit by single-colour triangles or by a constant environment. The
// others handle other shapes, lights and materials lane by lane.
#pragma once

#include <optional>
#include <vector>

#include "core/lanes/row_table.h"
#include "materials/material.h"
#include "scene/features.h"
#include "scene/flat_table.h"
#include "scene/scene.h"

namespace lancer {

enum class Shading {
    plain,     // no textures, one kind of light
    textured,  // Lambertian surfaces with textures, maps and cut-outs, any lights
    any,       // any material
};

struct WideScene {
    // Flags of eight lanes, gathered without branches: flags << i is ORed for lane i, after which byte k contains the
    // lanes for which flag k is set.
    struct LaneFlags {
        uint32_t bits = 0;
        void add(uint32_t i, uint32_t flags) { bits |= flags << i; }
        uint32_t lanes(uint32_t flag) const { return bits / flag & 255; }
    };
    // Flags of triangles.
    static constexpr uint32_t is_drawn = 1, is_straight = 1u << 8,
                              is_fixed = 1u << 16,  // straight: no bump or normal map; fixed: see Fixed::is
        is_mirroring = 1u << 24;                    // MaterialTraits::mirrors
    // Flags of BSDFs.
    static constexpr uint32_t is_non_lambert = 1, is_queued = 1u << 8, is_only_delta = 1u << 16,
                              is_transmissive = 1u << 24;

    // Rows of a triangle light: its corners, with PointOnTriangle::rounding() behind the first one; the normal of its
    // front side and its area; the radiance of both sides, with the selection probability behind the front's.
    enum LightRow : size_t { corner_a, corner_b, corner_c, normal_area, front, back, light_rows };
    // A sphere light.
    struct alignas(32) SphereLightRow {
        std::array<double, 4> center_radius{};
        Row radiance;        // of its outside; w: selection probability
        float rounding = 0;  // rounding_on()
    };
    // How a light is sampled by the wide kernel.
    enum class LightKind : uint8_t {
        triangle,  // not instanced, of one colour
        sphere,    // of one colour
        constant_environment,
        other,  // by the scalar functions
    };

    // Features that each Shading supports, in addition to those of the previous one. `plain` supports either triangle
    // lights or a constant environment, not both.
    static constexpr Features plain{Feature::vertex_normals, feature_of(MaterialType::lambert),
                                    Feature::triangle_lights, Feature::constant_sky, Feature::light_tree};
    static constexpr Features textured =
        Features::all_lights() | Features{Feature::spheres,     Feature::planes,        Feature::instances,
                                          Feature::motion,      Feature::textures,      Feature::bump_maps,
                                          Feature::normal_maps, Feature::vertex_colors, Feature::cut_outs,
                                          Feature::sky_map,     Feature::background,    Feature::textured_lights};
    static constexpr Features any = Features::all_materials();

    // The BSDFs of a material that are the same everywhere, for the back and the front side.
    struct Fixed {
        bool is = false;     // false: the BSDF depends on the point
        bool turns = false;  // of the point by the tangent alone: PrincipledBsdf::turn_of()
        std::array<AnyBsdf, 2> bsdf{};
        std::array<uint32_t, 2> flags{};  // bsdf_flags() of each
    };

    Shading shading = Shading::plain;           // see of()
    RowTable<1> albedo;                         // of each material without textures
    FlatTable flat;                             // only for Shading::plain
    std::vector<uint8_t> shines;                // per material: whether any side emits
    std::vector<uint32_t> triangle_flags;       // per material: flags of its non-instanced triangles
    std::vector<Fixed> fixed;                   // per material; not for Shading::plain
    bool has_colors = false;                    // some mesh has vertex colours
    bool has_principled = false;                // some material is principled
    bool has_rough_glass = false;               // some material is rough glass
    bool has_rough_metal = false;               // some material is rough metal
    std::vector<LightKind> light_kinds;         // parallel to Scene::lights
    RowTable<light_rows> lights;                // parallel to Scene::lights if there are triangle lights
    std::vector<SphereLightRow> sphere_lights;  // parallel to Scene::lights if there are sphere lights
    bool has_triangles_only = false;            // all lights are of kind triangle

    // Tables for the plainest shading that supports the scene, but not plainer than `least`. Returns nothing if the
    // scene has unsupported features.
    static std::optional<WideScene> of(const Scene& scene, Shading least = Shading::plain);
};

// Whether points of a BSDF are processed together: see materials/lane_queue.h.
template <Bsdf B>
bool is_queued(const B& bsdf)
{
    if constexpr (std::is_same_v<B, PrincipledBsdf>) return bsdf.is_queued;
    if constexpr (std::is_same_v<B, GlassBsdf>) return bsdf.is_rough_boundary();
    if constexpr (std::is_same_v<B, MetalBsdf>) return !bsdf.only_delta();
    return std::is_same_v<B, PlasticBsdf>;
}
// Flags of a BSDF: not Lambertian, processed together, only delta lobes, transmissive.
template <Bsdf B>
uint32_t bsdf_flags(const B& bsdf)
{
    if constexpr (std::is_same_v<B, LambertBsdf>) return 0;
    return WideScene::is_non_lambert | (is_queued(bsdf) ? WideScene::is_queued : 0) |
           (bsdf.only_delta() ? WideScene::is_only_delta : 0) | (bsdf.transmits() ? WideScene::is_transmissive : 0);
}

}  // namespace lancer
