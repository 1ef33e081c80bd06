// Normalisation of the scene's units, and the placement of meshes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/bounds.h"
#include "core/transform.h"
#include "geometry/motion.h"
#include "scene/description/description.h"

namespace lancer {

// From file units to scene units: x -> (x - center) * scale. scale is a power of two, so that a scene scaled by 2^k
// has the very same numbers inside; center is 0 unless the scene lies more than 8 extents from the origin.
struct Normalisation {
    Vec3d center{};
    double scale = 1;

    Vec3d to_scene(Vec3d p) const { return (p - center) * scale; }
    Vec3d to_file(Vec3d p) const { return p / scale + center; }
};

// The normalisation that scales the bounds to an extent in [1, 2). It translates only scenes far from the origin, as a
// translation costs a rounding.
Normalisation normalise(const Bounds& b);
Transform to_transform(const Normalisation& n);
Transform to_transform(const TransformDescription& t);

// The way of a sphere while the shutter is open, in scene units; empty if it stands still.
Steps<Sphere> steps_of(const SphereDescription& sphere, const Normalisation& normalisation);

Bounds bounds_of(const MeshData& data);
// Bounds of the transformed corners.
Bounds transformed(const Bounds& b, const Transform& m);

// Bounds, in file units, of what a default camera should see: everything but planes and spheres much larger than the
// rest.
Bounds subject_bounds(const SceneDescription& description);

// Those of all its `[[instance]]`s.
inline size_t instance_count(const SceneDescription& description)
{
    size_t count = 0;
    for (const InstanceDescription& i : description.instances) count += i.count();
    return count;
}

// Transforms and instances of the description's meshes.
struct Placement {
    std::map<std::string, uint32_t> by_name;
    std::vector<bool> instanced;

    explicit Placement(const SceneDescription& d) : instanced(d.meshes.size())
    {
        for (uint32_t i = 0; i < d.meshes.size(); ++i)
            if (!d.meshes[i].name.empty()) by_name.emplace(d.meshes[i].name, i);
        for (const auto& instance : d.instances)
            if (const auto it = by_name.find(instance.mesh); it != by_name.end()) instanced[it->second] = true;
    }
};

// Of each instanced mesh, in its file's units, so that they are computed once for all instances; else empty.
std::vector<Bounds> bounds_of_instanced(const SceneDescription& description, const Placement& placement);

}  // namespace lancer
