// Lights, and how to choose and sample one. Pharr, Jakob, Humphreys, 4th ed., chapter 12.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/color.h"
#include "core/distribution.h"
#include "core/vec.h"

namespace lancer {

class LightTree;
struct Scene;
struct Surface;

struct PointLight {
    Vec3 position;
    Color intensity;  // per square scene unit
};
struct DirectionalLight {
    Vec3 wi;           // towards it, unit
    Color irradiance;  // on a surface that faces it
};
struct SphereLight {
    uint32_t sphere;  // its emission is that of its material
};
struct TriangleLight {
    uint32_t instance, mesh, triangle;
    // Of a flat triangle that is drawn as it is; else looked up where it is sampled, and area is 0.
    Vec3 n{};
    float area = 0;
};
struct EnvironmentLight {};  // all of Scene::radiance_from(), by Scene::environment_table if it is not constant

using Light = std::variant<PointLight, DirectionalLight, SphereLight, TriangleLight, EnvironmentLight>;

struct LightTable {
    std::vector<Light> lights;  // point and directional ones first
    uint32_t deltas = 0;        // how many these are
    Discrete pick;              // by power
    // Of many lights those that are somewhere are chosen by what they may send to a place; their indices in it are
    // those in `lights`. The others, infinitely far away, are chosen by power, as is whether it is one of them.
    std::shared_ptr<const LightTree> tree;  // null: all by power
    std::vector<uint32_t> far;              // the others; only filled beside a tree
    double tree_share = 0;                  // the probability that it is none of these
};

struct LightSample {
    Vec3 wi;                  // unit, from the surface to the light
    Vec3 point{}, p_error{};  // on the light; unused if infinite
    Vec3 n{};                 // normal of the light there, for the offset of the shadow ray's end; 0 for a point light
    bool infinite = false;
    Color radiance;      // arriving if nothing is in between; of a delta light the irradiance on what faces it
    float pdf = 0;       // per solid angle, choice of the light included; 1 x choice for a delta light
    bool delta = false;  // no BSDF sample can meet it
};

// A light chosen by power or by the tree, and a point on it, as seen from where rays leave the surface on the side of
// from.n. Nothing if it cannot send light there. through: light shall also come through the surface; what lies behind
// it is then sampled as seen from where rays leave on the other side.
std::optional<LightSample> sample_light(const Scene& scene, const Surface& from, float pick, Vec2 u,
                                        bool through = false);

// The same of light `id`, which was chosen before by its power.
std::optional<LightSample> sample_chosen_light(const Scene& scene, const Surface& from, uint32_t id, Vec2 u,
                                               bool through = false);

// Light `id` of the table, its choice not counted in the density.
std::optional<LightSample> sample_given_light(const Scene& scene, const Surface& from, uint32_t id, Vec2 u,
                                              bool through = false);

// As sample_light(), but chosen among those alone that are neither points nor directional.
std::optional<LightSample> sample_extended_light(const Scene& scene, const Surface& from, float pick, Vec2 u);

// Density, per solid angle at `from`, with which sample_light() would have found the emitter at `at`, hit along wi
// (unit); 0 if it is in no list of lights. from: the origin of the ray that hit it; normal: the shading normal there.
float pdf_light(const Scene& scene, Vec3 from, Vec3 normal, Vec3 wi, const Surface& at);

// The same for a ray that left the scene. normal: the shading normal where it started.
float pdf_environment(const Scene& scene, Vec3 normal, Vec3 wi);

}  // namespace lancer
