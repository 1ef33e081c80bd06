// What an integrator may do where a ray ended: add light, ask whether a light is seen, send rays on. It never waits
// for an answer, so the kernel advances many paths at once and nothing recurses.
#pragma once

#include <limits>
#include <vector>

#include "core/color.h"
#include "core/ray.h"
#include "materials/medium.h"
#include "scene/surface.h"

namespace lancer {

// Parts of a path, as light is taken apart for teaching. Only the first two see what emits directly.
enum class PathSegment : uint8_t {
    view,      // from the camera, and on by mirrors and smooth glass
    direct,    // from the first surface that spreads light, once
    indirect,  // all that comes after
};

// One ray under way.
struct PathState {
    Ray ray;
    Color throughput{1, 1, 1};     // what the path so far does to light that comes along the ray
    Color importance{-1, -1, -1};  // see SamplingPlan::importance_at()
    float pdf = 0;                 // with which the BSDF chose the ray, per solid angle
    Vec3 normal;                   // shading normal where it started
    RayCone cone;                  // of the light that the ray stands for
    MediumStack media;             // what the ray is in; only kept in scenes that have media
    float eta_scale = 1;           // product of eta^2 over refractions: throughput times it speaks of energy
    uint32_t slot = 0;             // the sample that it adds to
    uint32_t branch = 0;           // part of the address of its random numbers; siblings differ
    uint32_t sample = 0;           // likewise: that of the sample until the path splits, then see SamplingPlan::parts
    uint32_t part = 0;             // of the random numbers: first one that the path takes when it splits
    uint32_t depth = 0;            // surface vertices before this ray
    bool specular = true;          // chosen by a delta lobe or by the camera
    bool light_sampled = false;    // where it started a light was sampled that might have been what it meets
    PathSegment segment = PathSegment::view;  // part of the path that the ray belongs to
    bool last = false;                        // only emission counts where it ends
    bool has_split = false;                   // the path has come by the vertex where it splits
};

// The light of a sample, summed in double: of a path of 1e5 vertices float would lose 2e-5.
struct RadianceSum {
    double r = 0, g = 0, b = 0;

    RadianceSum& operator+=(Color c)
    {
        r += double{c.r}, g += double{c.g}, b += double{c.b};
        return *this;
    }
    Color color() const { return {static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)}; }
    // What was added since.
    Color since(const RadianceSum& before) const
    {
        return RadianceSum{r - before.r, g - before.g, b - before.b}.color();
    }
};

// What steps collect, for a whole batch. Reused from batch to batch, so that no ray allocates.
struct Queue {
    struct Shadow {
        Color radiance;  // if nothing is in between
        uint32_t slot;   // the sample that it adds to
    };
    std::vector<RadianceSum> radiance;  // of each slot
    struct TintedShadow {
        Ray ray;
        Color radiance;  // if nothing more is in between
        Color light;     // what is left of the light's own colour, likewise
        uint32_t slot;
        MediumStack media{};  // that it is in
    };
    std::vector<Ray> shadow_rays;
    std::vector<Shadow> shadows;  // parallel to shadow_rays
    std::vector<TintedShadow> tinted_shadows;
    std::vector<PathState> next;
};

// The steps of one sample. A shadow ray that would bring nothing is not traced.
// Their order is the order of summation: all adds of a depth, then its shadow rays, then its
// tinted ones, those that went through fewer surfaces first.
class PathActions {
public:
    PathActions(Queue& queue, uint32_t slot) : queue_(queue), slot_(slot) {}

    void add(Color radiance) { queue_.radiance[slot_] += radiance; }
    void shadow(const Ray& ray, Color radiance_if_unoccluded)
    {
        shadow_from([&](Ray& r) { r = ray; }, radiance_if_unoccluded);
    }
    // The same with a ray that is still to be written: f(ray) changes what a new one holds.
    template <class F>
    void shadow_from(F&& f, Color radiance_if_unoccluded)
    {
        if (is_black(radiance_if_unoccluded)) return;
        Ray& ray = queue_.shadow_rays.emplace_back();
        f(ray);
        if (!is_traceable(ray)) {
            queue_.shadow_rays.pop_back();
            return invalidate();
        }
        queue_.shadows.push_back({radiance_if_unoccluded, slot_});
    }
    // As shadow(), but what lies in between takes only its part: the integrator's through() says which. light: the
    // colour of the light itself, for is_spent().
    void tinted_shadow(const Ray& ray, Color radiance_if_unoccluded, Color light)
    {
        if (is_black(radiance_if_unoccluded)) return;
        if (!is_traceable(ray)) return invalidate();
        queue_.tinted_shadows.push_back({ray, radiance_if_unoccluded, light, slot_});
    }
    void next(const PathState& state)
    {
        if (!is_traceable(state.ray)) return invalidate();
        queue_.next.push_back(state);
    }
    // A next ray that is still to be written: a copy of `from` for f to change. f says whether it shall go on.
    template <class F>
    void next_from(const PathState& from, F&& f)
    {
        PathState& n = queue_.next.emplace_back(from);
        const bool goes_on = f(n);
        if (goes_on && is_traceable(n.ray)) return;
        queue_.next.pop_back();
        if (goes_on) invalidate();
    }

    // A ray that is not a number spoils its sample: dropped and counted in the end, never silently black.
    void invalidate() { queue_.radiance[slot_].r = std::numeric_limits<double>::quiet_NaN(); }

private:
    Queue& queue_;
    uint32_t slot_;
};

}  // namespace lancer
