// Things that move while the shutter is open: instances and spheres, straight from place to place.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "geometry/shapes.h"

namespace lancer {

// The places of a shape at even steps of time from the opening of the shutter to its closing; between two of them each
// number of a Transform or Sphere goes straight, and so does each point. Empty: it stands still.
template <class Place>
using Steps = std::vector<Place>;

struct Motion {
    // Empty, or one entry for each instance (its Instance::to_world) or sphere of a Geometry, whose own place is the
    // first step.
    std::vector<Steps<Transform>> instances;
    std::vector<Steps<Sphere>> spheres;

    bool moves() const { return !instances.empty() || !spheres.empty(); }
};

template <class Place>
bool is_moving(const std::vector<Steps<Place>>& all, size_t number)
{
    return !all.empty() && !all[number].empty();
}

// A path that goes nowhere is as good as none.
template <class Place>
bool stand_still(const Steps<Place>& steps)
{
    return std::all_of(steps.begin(), steps.end(), [&](const Place& at) { return at == steps[0]; });
}

inline Sphere between(const Sphere& a, const Sphere& b, double x)
{
    return {a.center + (b.center - a.center) * x, a.radius + (b.radius - a.radius) * x};
}
inline Transform between(const Transform& a, const Transform& b, double x)
{
    const auto mixed = [x](Vec3d from, Vec3d to) { return from + (to - from) * x; };
    return {mixed(a.x, b.x), mixed(a.y, b.y), mixed(a.z, b.z), mixed(a.translation, b.translation)};
}
// time: in [0, 1]; steps: two at least.
template <class Place>
Place place_at(const Steps<Place>& steps, float time)
{
    const auto last = static_cast<double>(steps.size() - 1);
    const double x = std::clamp(static_cast<double>(time), 0.0, 1.0) * last;
    const auto i = std::min(steps.size() - 2, static_cast<size_t>(x));
    return between(steps[i], steps[i + 1], x - static_cast<double>(i));
}

// A shape where it is at a time. One that stands still is referred to, not copied.
template <class Shape>
class ShapeAt {
public:
    explicit ShapeAt(const Shape& still) : shape_(&still) {}
    ShapeAt(const ShapeAt&) = delete;
    ShapeAt& operator=(const ShapeAt&) = delete;

    const Shape& operator*() const { return *shape_; }
    const Shape* operator->() const { return shape_; }

protected:
    void move_to(const Shape& place) { shape_ = &own_.emplace(place); }

private:
    const Shape* shape_;
    std::optional<Shape> own_;
};

class SphereAt : public ShapeAt<Sphere> {
public:
    // number: of the sphere; time: Ray::time.
    SphereAt(const std::vector<Sphere>& spheres, const Motion& motion, uint32_t number, float time)
        : ShapeAt(spheres[number])
    {
        if (is_moving(motion.spheres, number)) [[unlikely]]
            move_to(place_at(motion.spheres[number], time));
    }
};

class InstanceAt : public ShapeAt<Instance> {
public:
    InstanceAt(const std::vector<Instance>& instances, const Motion& motion, uint32_t number, float time)
        : ShapeAt(instances[number])
    {
        if (is_moving(motion.instances, number)) [[unlikely]] {
            const Transform to_world = place_at(motion.instances[number], time);
            move_to({instances[number].mesh, to_world, inverse(to_world)});
        }
    }
};

// Calls f with the places of a shape whose own one is `still`: that one, or each of its steps. A box around them is one
// around all that lies between.
template <class Place, class F>
void for_each_place(const Place& still, const std::vector<Steps<Place>>& moving, size_t number, const F& f)
{
    if (!is_moving(moving, number)) return f(still);
    for (const Place& place : moving[number]) f(place);
}

}  // namespace lancer
