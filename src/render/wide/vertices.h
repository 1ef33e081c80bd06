// The data of eight vertices of a WideBatch.
#pragma once

#include <array>
#include <optional>
#include <type_traits>

#include "geometry/hit_lanes.h"
#include "materials/material.h"
#include "render/wide/queues.h"
#include "render/wide/states.h"
#include "scene/lights/wide.h"
#include "scene/triangle_interaction.h"

namespace lancer::wide {

// Room for a BSDF. A variant would clear all of it, for each lane of each batch.
union OwnBsdf {
    OwnBsdf() {}
    AnyBsdf bsdf;
};
// The lanes whose material is not Lambertian.
struct NonLambert {
    uint32_t lanes;                                // lanes that are not Lambertian
    std::array<const AnyBsdf*, float_lanes> bsdf;  // their BSDFs; of queued ones only if they are the same everywhere
    uint32_t only_delta, transmits;                // lanes whose BSDF says so
    Vec3x8 p, p_error;                             // as in Surface
    Vec3x8 wo;                                     // local
    MaterialQueues::Eights queued;                 // points in the queues
    std::array<OwnBsdf, float_lanes> own;          // storage of BSDFs that depend on the point
    uint32_t seen;                                 // other principled lanes, seen from the front; their lobes:
    std::array<std::optional<PrincipledBsdf::Seen>, float_lanes> lobes;
    // Only set if there are mirrors: lanes that follow_mirror() concerns, the PathState::pdf, mirror_distance and
    // normal that it keeps.
    uint32_t mirrored;
    Float8 mirrored_pdf, mirror_distance;
    Vec3x8 mirrored_normal;
};
struct Empty {};
// Which data the surfaces need.
struct SurfaceQuery {
    // drawn: lanes with non-instanced triangles; of these, straight: without normal or bump maps; of these, fixed: the
    // BSDF is the same everywhere, mirroring: specular.
    uint32_t drawn, straight, fixed, mirroring;
    Vec3x8 wo;                      // world
    uint32_t front;                 // lanes hit from the front
    InteractionLanes interactions;  // of non-instanced triangles
};
// Eight vertices.
template <Shading shading>
struct Vertices {
    static constexpr bool textured = shading != Shading::plain, any = shading == Shading::any;
    using Lanes = std::conditional_t<any, AnyPathLanes, std::conditional_t<textured, ConePathLanes, PathLanes>>;

    size_t first, count;  // of their rays
    uint32_t hit;         // active lanes
    uint32_t shining;     // active lanes with an emissive material
    Lanes path;
    Vec3x8 albedo;
    Vec3x8 n, ns, origin;    // as in Surface
    uint32_t samples_light;  // lanes that sample a light
    UInt8 light_cell;        // see LightChoice; only set if there is one, like light_rate
    Float8 light_rate;
    Float8 cos_o;  // between the shading normal and wo
    Float8 width;  // of the cone, where textures are looked up
    UInt8 material;
    UInt8 leaf_hint;  // Ray::leaf_hint of rays that start there
    [[no_unique_address]] std::conditional_t<textured, SurfaceQuery, Empty> found;
    [[no_unique_address]] std::conditional_t<any, NonLambert, Empty> non_lambert;
};

// The lights selected by the lanes.
struct ChosenLights {
    UInt8 ids{};
    UInt8 options{};                      // of LightChoice, if it chose
    uint32_t tiles = 0;                   // lanes that chose a tile of the sky, which has no id
    Vec2x8 u;                             // random numbers for the point on the light
    std::optional<Float8> probability{};  // of the selection, if not by power
    const Float8* choice() const { return probability ? &*probability : nullptr; }
};
// A light sample of eight vertices.
struct LightQuery {
    uint32_t active = 0;    // lanes that sample a light
    bool by_place = false;  // by LightChoice
    LightSampleLanes light;
    UInt8 ids;  // of the lights
    Vec3x8 wi;  // direction to the light, local; of lanes that are not Lambertian
};
// BSDF sampling of eight vertices, part by part.
struct ScatterState {
    uint32_t sends, splits;  // lanes
    // Shared by all parts of a path.
    Vec3x8 throughput;
    Float8 eta_scale, spread;
    UInt8 spreading, straight;  // path_flags of rays from non-specular and from specular lobes
    // Random numbers of the present part.
    Float8 lobe;
    Vec2x8 u;
    Vec3x8 cosine;
};
// Sampled directions.
struct BsdfSamples {
    Vec3x8 wi, weight;  // as in BsdfSample, like the following
    Float8 pdf{}, eta;
    uint32_t delta = 0;
    uint32_t lanes = 0;  // valid lanes
};

}  // namespace lancer::wide
