// The interface between integrators and kernels. An integrator describes what a path does at a vertex: it adds
// radiance, requests shadow rays and continues rays. It never waits for an answer, so that the kernel advances many
// paths at once without recursion.
#pragma once

#include <limits>
#include <vector>

#include "core/color.h"
#include "core/layers.h"
#include "core/ray.h"
#include "materials/medium.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace lancer {

// The state of one path: its next ray and what the integrator needs to continue it.
struct PathState {
    Ray ray;
    Color throughput{1, 1, 1};     // of the path up to this ray
    Color importance{-1, -1, -1};  // see SamplingPlan::importance_at()
    float pdf = 0;               // density of the BSDF's sample per solid angle, over the rate of light sampling there
    uint32_t cell = 0;           // of the ray's origin, if lights are chosen by place; see LightChoice
    Vec3 normal;                 // shading normal at the ray's origin; 0 where a medium scattered
    RayCone cone;                // ray cone, for texture filtering
    MediumStack media;           // media around the ray; only in scenes that have media
    float eta_scale = 1;         // product of eta^2 over refractions; throughput times eta_scale is energy
    uint32_t slot = 0;           // index of the sample to which it adds
    uint32_t branch = 0;         // part of the sampler's address; rays of one path differ in it
    uint32_t sample = 0;         // likewise: the sample's index until the path splits, then see SamplingPlan::parts
    uint32_t depth = 0;          // number of vertices before this ray: at surfaces, and where a medium scattered
    bool specular = true;        // sampled from a delta lobe or by the camera
    bool light_sampled = false;  // light sampling at its origin could have found what it hits
    PathSegment segment = PathSegment::view;  // segment of the path
    bool last = false;                        // only emission counts at its end
    bool has_split = false;                   // the path has passed the vertex where it splits
    uint8_t mirror = 0;                       // that the ray has hit: Scene::mirror_at(), if the integrator uses it
    uint16_t part = 0;                        // first part of the random numbers that the path uses when it splits
    // > 0: the ray comes from a mirror by way of which its last vertex sampled lights; the distance between these.
    // < 0: the ray has passed surfaces that are not there; minus the distance from its last vertex.
    float mirror_distance = 0;

    bool has_passed() const { return mirror_distance < 0; }
    // Distance of the ray's origin from the last vertex.
    float passed_distance() const { return has_passed() ? -mirror_distance : 0; }
    // The last vertex, as light sampling there knew it.
    Vec3 vertex() const { return has_passed() ? ray.org + ray.dir * mirror_distance : ray.org; }
    // Whether the last vertex is one where a medium scattered: it has no normal.
    bool is_from_medium() const { return normal == Vec3{}; }
};

// The radiance of a sample, summed in double: on a path of 1e5 vertices float would lose 2e-5.
struct RadianceSum {
    double r = 0, g = 0, b = 0;

    RadianceSum& operator+=(Color c)
    {
        r += double{c.r}, g += double{c.g}, b += double{c.b};
        return *this;
    }
    Color color() const { return {static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)}; }
    // Difference to an earlier value.
    Color since(const RadianceSum& before) const
    {
        return RadianceSum{r - before.r, g - before.g, b - before.b}.color();
    }
};

// Where the light of a shadow ray goes and comes from.
struct ShadowEnds {
    uint32_t slot = 0;                            // the sample that it adds to
    uint32_t light = Scene::none;                 // id in Scene::lights; none: the sky, or nobody said
    PathSegment segment = PathSegment::indirect;  // that the shadow ray is
    uint32_t share = 0;                           // see PathTrails::of_shadow(), if the film has layers of lobes
    bool from_medium = false;                     // it starts where a medium scatters
};

// The queues that PathActions fills for a whole batch. They are reused from batch to batch, so that no ray allocates
// memory.
struct Queue {
    struct Shadow {
        Color radiance;  // if nothing is in between
        ShadowEnds ends;
    };
    std::vector<RadianceSum> radiance;  // of each slot
    struct TintedShadow {
        Ray ray;
        Color radiance;  // if nothing more is in between
        Color light;     // what is left of the light's own colour, likewise
        ShadowEnds ends;
        MediumStack media{};        // that it is in
        bool passes_sheets = true;  // else it ends at all surfaces but those that are not there
    };
    struct MirroredShadow {
        Ray ray;         // to the mirror
        Color radiance;  // if nothing is in between and the mirror loses nothing
        LightSample light;
        ShadowEnds ends;
        uint8_t mirror;  // see Scene::mirror_at()
    };
    std::vector<Ray> shadow_rays;
    std::vector<Shadow> shadows;  // parallel to shadow_rays
    std::vector<TintedShadow> tinted_shadows;
    std::vector<MirroredShadow> mirrored_shadows;
    std::vector<PathState> next;
};

// How much a queue holds, to know later what a vertex has added.
struct QueueSizes {
    size_t next = 0, shadows = 0, tinted_shadows = 0, mirrored_shadows = 0;

    QueueSizes() = default;
    explicit QueueSizes(const Queue& q)
        : next(q.next.size()),
          shadows(q.shadows.size()),
          tinted_shadows(q.tinted_shadows.size()),
          mirrored_shadows(q.mirrored_shadows.size())
    {
    }
};

// The actions of one sample. Shadow rays without radiance are not traced. The order of summation is fixed: all add() of
// a depth, then its shadow rays, then its tinted shadow rays, those that crossed fewer surfaces first, then those by
// way of mirrors.
class PathActions {
public:
    // shadows: the segment that its shadow rays are.
    PathActions(Queue& queue, uint32_t slot, PathSegment shadows = PathSegment::indirect)
        : queue_(queue), slot_(slot), shadows_(shadows)
    {
    }

    void add(Color radiance) { queue_.radiance[slot_] += radiance; }
    void shadow(const Ray& ray, Color radiance_if_unoccluded, uint32_t light = Scene::none)
    {
        shadow_from([&](Ray& r) { r = ray; }, radiance_if_unoccluded, light);
    }
    // The same; f(ray) fills a default ray in the queue.
    template <class F>
    void shadow_from(F&& f, Color radiance_if_unoccluded, uint32_t light = Scene::none)
    {
        if (is_black(radiance_if_unoccluded)) return;
        Ray& ray = queue_.shadow_rays.emplace_back();
        f(ray);
        if (!is_traceable(ray)) {
            queue_.shadow_rays.pop_back();
            return invalidate();
        }
        queue_.shadows.push_back({radiance_if_unoccluded, ends(light)});
    }
    // As shadow(), but surfaces in between attenuate the light by the integrator's through() instead of blocking it.
    // light: the light's own radiance, for is_spent(). passes_sheets: see Queue::TintedShadow.
    void tinted_shadow(const Ray& ray, Color radiance_if_unoccluded, Color light, uint32_t to = Scene::none,
                       bool passes_sheets = true)
    {
        if (is_black(radiance_if_unoccluded)) return;
        if (!is_traceable(ray)) return invalidate();
        queue_.tinted_shadows.push_back({ray, radiance_if_unoccluded, light, ends(to), {}, passes_sheets});
    }
    // A shadow ray from a place in a medium, where `media` are; tinted: as tinted_shadow().
    void medium_shadow(const Ray& ray, Color radiance_if_unoccluded, const LightSample& light, const MediumStack& media,
                       bool tinted)
    {
        if (is_black(radiance_if_unoccluded)) return;
        if (!is_traceable(ray)) return invalidate();
        ShadowEnds to = ends(light.light);
        to.from_medium = true;
        if (tinted) {
            queue_.tinted_shadows.push_back({ray, radiance_if_unoccluded, light.radiance, to, media, light.delta});
            return;
        }
        queue_.shadow_rays.push_back(ray);
        queue_.shadows.push_back({radiance_if_unoccluded, to});
    }
    // A shadow ray by way of a mirror.
    void mirrored_shadow(const Ray& to_mirror, Color radiance_if_unoccluded, const LightSample& light, uint8_t mirror)
    {
        if (is_black(radiance_if_unoccluded)) return;
        if (!is_traceable(to_mirror)) return invalidate();
        queue_.mirrored_shadows.push_back({to_mirror, radiance_if_unoccluded, light, {slot_, light.light}, mirror});
    }
    void next(const PathState& state)
    {
        if (!is_traceable(state.ray)) return invalidate();
        queue_.next.push_back(state);
    }
    // The same with a copy of `from` that f changes in the queue. f returns whether the ray is continued.
    template <class F>
    void next_from(const PathState& from, F&& f)
    {
        PathState& n = queue_.next.emplace_back(from);
        const bool goes_on = f(n);
        if (goes_on && is_traceable(n.ray)) return;
        queue_.next.pop_back();
        if (goes_on) invalidate();
    }

    // Marks the sample as invalid (NaN): the kernel drops and counts it, so that it does not become black.
    void invalidate() { queue_.radiance[slot_].r = std::numeric_limits<double>::quiet_NaN(); }

private:
    ShadowEnds ends(uint32_t light) const { return {slot_, light, shadows_}; }

    Queue& queue_;
    uint32_t slot_;
    PathSegment shadows_;
};

}  // namespace lancer
