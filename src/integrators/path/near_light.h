// Places along a ray from which a light is seen under angles that are spread evenly, for media near lights: Kulla and
// Fajardo, "Importance Sampling Techniques for Path Tracing in Participating Media", EGSR 2012.
#pragma once

#include <cmath>
#include <optional>

#include "core/ray.h"
#include "integrators/media.h"

namespace lancer {

class NearLight {
public:
    // For a light of the table, if it pays: the light has a place, and the flight is so long, and the medium so thin,
    // that the light is much brighter in a part of the flight than elsewhere.
    static std::optional<NearLight> of(const Scene& scene, const Ray& ray, const Flight& flight, uint32_t light)
    {
        if (flight.medium->is_dense) return {};
        const std::optional<Vec3> middle = middle_of_light(scene, light);
        if (!middle) return {};
        NearLight n;
        const Vec3d to = to_double(*middle - ray.org), dir = to_double(ray.dir);
        n.closest_ = dot(to, dir);
        n.distance_ = length(to - dir * n.closest_);
        const double near = double{flight.near}, far = double{flight.far};
        const double off = n.closest_ - std::clamp(n.closest_, near, far);
        const double reach = std::min(far - near, 1 / double{max_component(flight.medium->extinction())});
        constexpr double close = 0.5;  // of the reach
        if (!(n.distance_ > 0) || !(std::hypot(n.distance_, off) < close * reach)) return {};
        n.begin_ = std::atan((near - n.closest_) / n.distance_);
        n.end_ = std::atan((far - n.closest_) / n.distance_);
        return n.end_ > n.begin_ ? std::optional(n) : std::nullopt;
    }
    // A distance along the ray; u in [0, 1).
    float sample(float u) const
    {
        return static_cast<float>(closest_ + distance_ * std::tan(begin_ + (end_ - begin_) * double{u}));
    }
    // Its density, within the flight.
    float pdf(float t) const
    {
        const double along = double{t} - closest_;
        return static_cast<float>(distance_ / ((end_ - begin_) * (distance_ * distance_ + along * along)));
    }

private:
    double closest_ = 0, distance_ = 0;  // where the light is closest to the ray's line, and how far from it
    double begin_ = 0, end_ = 0;         // angles of the flight as the light sees it
};

}  // namespace lancer
