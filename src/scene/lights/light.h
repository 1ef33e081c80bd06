// Lights, and how to choose and sample one. Pharr, Jakob, Humphreys, 4th ed., chapter 12.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/color.h"
#include "core/distribution.h"
#include "core/vec.h"
#include "scene/lights/directional.h"
#include "scene/lights/emission_map.h"
#include "scene/lights/light_sample.h"
#include "scene/lights/point.h"
#include "scene/lights/spot.h"

namespace lancer {

class LightTree;
struct Scene;
struct Surface;

// Delta lights, which no ray can hit, in the order in which the table has them. Each has
//   make(description, normalisation)   from a LightDescription
//   sample(org)                        as sample_light(), seen from org; nothing if no light arrives
//   power(area)                        for the selection: emitted luminance in scene units; a light at infinity
//                                      illuminates `area`
//   bounds()                           for the light tree; nothing if the light is at infinity
//   undimmed(org, scale)               see UndimmedLight; scale: of the normalisation
using DeltaLight = std::variant<PointLight, DirectionalLight, SpotLight>;
static_assert(std::variant_size_v<DeltaLight> + 2 == enum_names<LightType>.size(),
              "each LightType is a delta light, but the sphere and the environment");

struct SphereLight {
    static constexpr LightType type = LightType::sphere;
    uint32_t sphere;  // index; its material has the emission
};
struct TriangleLight {
    uint32_t instance, mesh, triangle;
    // Of a flat, non-instanced triangle; else area is 0 and they are computed when it is sampled.
    Vec3 n{};
    float area = 0;
    uint32_t map = no_map;  // in LightTable::maps
    static constexpr uint32_t no_map = UINT32_MAX;
};
struct EnvironmentLight {};  // all of Scene::radiance_from(), by Scene::environment_table if it is not constant

using Light = std::variant<PointLight, DirectionalLight, SpotLight, SphereLight, TriangleLight, EnvironmentLight>;

template <class L>
inline constexpr bool is_delta_light = std::is_constructible_v<DeltaLight, L>;

struct LightTable {
    std::vector<Light> lights;      // delta lights first
    uint32_t deltas = 0;            // number of these
    std::vector<EmissionMap> maps;  // of triangles whose picture is sampled by its brightness
    Discrete pick;                  // selection by power
    // With many lights, those with a position are selected by a tree, whose indices are those of `lights`. Lights at
    // infinity are selected by power, as is whether to use the tree.
    std::shared_ptr<const LightTree> tree;  // null: all lights by power
    std::vector<uint32_t> far;              // lights at infinity; only set with a tree
    double tree_share = 0;                  // probability of using the tree
};

// Selects a light by power or by the tree and samples a point on it, as seen from the side of from.n. Returns nothing
// if it cannot illuminate the surface. through: also lights behind the surface, seen from its other side.
std::optional<LightSample> sample_light(const Scene& scene, const Surface& from, float pick, Vec2 u,
                                        bool through = false);

// The same for light `id`, selected before by its power.
std::optional<LightSample> sample_chosen_light(const Scene& scene, const Surface& from, uint32_t id, Vec2 u,
                                               bool through = false);

// The same, selected with the given probability.
std::optional<LightSample> sample_chosen_light(const Scene& scene, const Surface& from, uint32_t id, float probability,
                                               Vec2 u, bool through);

// Samples light `id`; the density does not include the selection.
std::optional<LightSample> sample_given_light(const Scene& scene, const Surface& from, uint32_t id, Vec2 u,
                                              bool through = false);

// From a place that is on no surface, which light reaches from all sides. Selects a light by power or by the tree.
std::optional<LightSample> sample_light_from(const Scene& scene, Vec3 place, float pick, Vec2 u);
// Samples light `id` from there; the density does not include the selection.
std::optional<LightSample> sample_given_light_from(const Scene& scene, Vec3 place, uint32_t id, Vec2 u);
// The middle of a light that has a place in the scene.
std::optional<Vec3> middle_of_light(const Scene& scene, uint32_t id);

// The sky in direction wi (unit), as sample_given_light() would find it; nothing if it cannot illuminate the surface.
// The density may be 0.
std::optional<LightSample> sample_sky(const Scene& scene, const Surface& from, Vec3 wi, bool through);

// As sample_light(), restricted to lights that are not delta lights.
std::optional<LightSample> sample_extended_light(const Scene& scene, const Surface& from, float pick, Vec2 u);

// Density, per solid angle at `from`, with which sample_light() samples the emitter at `at`, hit in direction wi
// (unit); 0 if it is not in the table. from: origin of the ray; normal: the shading normal there, or 0 for the density
// of sample_light_from().
float pdf_light(const Scene& scene, Vec3 from, Vec3 normal, Vec3 wi, const Surface& at);

// The same for a light of the table that is selected with the given probability.
float pdf_light(const Scene& scene, Vec3 from, Vec3 wi, const Surface& at, float probability);

// The same for a ray that left the scene. normal: the shading normal at its origin.
float pdf_environment(const Scene& scene, Vec3 normal, Vec3 wi);
float pdf_environment(const Scene& scene, Vec3 normal, Vec3 wi, float probability);

}  // namespace lancer
