// What a WideBatch knows of eight vertices, step by step.
#pragma once

#include <array>
#include <optional>
#include <type_traits>

#include "geometry/hit_lanes.h"
#include "materials/material.h"
#include "materials/plastic_queue.h"
#include "render/wide/states.h"
#include "scene/lights/wide.h"
#include "scene/triangle_interaction.h"

namespace lancer::wide {

// What of them is not matt, and what that wants to know.
struct NonLambert {
    uint32_t lanes;                                // that are not
    std::array<const AnyBsdf*, float_lanes> bsdf;  // of these, but for plastic that was looked up
    uint32_t only_delta, transmits;                // lanes whose BSDF says so
    Vec3x8 p, p_error;                             // as in Surface
    Vec3x8 wo;                                     // local
    PlasticQueue::Eight plastic;
    std::array<AnyBsdf, float_lanes> own;  // those that were looked up for them
};
struct Empty {};
// What is looked up of them.
struct SurfaceQuery {
    // Lanes of triangles that are drawn as they are; of these, those that are not tilted; and of these, those of
    // which nothing is to be looked up, and those that want to mirror away from the surface.
    uint32_t drawn, straight, fixed, mirroring;
    Vec3x8 wo;                // world
    uint32_t front;           // lanes of triangles whose rays come to the front
    InteractionLanes places;  // of triangles that are drawn as they are
};
// Eight vertices.
template <Shading shading>
struct Vertices {
    static constexpr bool textured = shading != Shading::plain, any = shading == Shading::any;
    using Lanes = std::conditional_t<any, AnyPathLanes, std::conditional_t<textured, ConePathLanes, PathLanes>>;

    size_t first, count;  // of the rays that ended there
    uint32_t hit;         // lanes that there are
    uint32_t shining;     // those of these whose material does
    Lanes path;
    Vec3x8 albedo;
    Vec3x8 n, ns, origin;  // as in Surface
    Float8 cos_o;          // between the shading normal and the way back
    Float8 width;          // of the cone, where textures are looked up
    UInt8 material;
    UInt8 leaf_hint;  // of rays that leave them, as in Ray
    [[no_unique_address]] std::conditional_t<textured, SurfaceQuery, Empty> found;
    [[no_unique_address]] std::conditional_t<any, NonLambert, Empty> non_lambert;
};

// Which lights lanes sample.
struct ChosenLights {
    UInt8 ids{};
    Vec2x8 u;                             // for a point on them
    std::optional<Float8> probability{};  // of the choice, if not that by power
    const Float8* choice() const { return probability ? &*probability : nullptr; }
};
// What eight vertices see of the light that was sampled.
struct LightQuery {
    uint32_t active = 0;  // lanes in which it was
    LightSampleLanes light;
    Vec3x8 wi;  // to it, local; of what is not matt
};
// Eight vertices that send rays on.
struct ScatterState {
    uint32_t sends, splits;  // lanes
    // What all parts of the paths share, before BSDFs have been asked.
    Vec3x8 throughput;
    Float8 eta_scale, spread;
    UInt8 spreading, straight;  // so_far behind a lobe that spreads light, and behind one that does not
    // Of the part that is sent.
    Float8 lobe;
    Vec2x8 u;
    Vec3x8 cosine;
};
// Directions that BSDFs chose.
struct BsdfSamples {
    Vec3x8 wi, weight;  // as in BsdfSample, and so what follows
    Float8 pdf{}, eta;
    uint32_t delta = 0;
    uint32_t lanes = 0;  // that there are
};

}  // namespace lancer::wide
