#include "app/defaults/key_light.h"

#include "scene/placement.h"

namespace lancer {
bool is_inside(const SceneDescription& scene)
{
    const Bounds b = subject_bounds(scene);
    const Vec3d p = scene.camera->position;
    return p.x > b.lower.x && p.y > b.lower.y && p.z > b.lower.z && p.x < b.upper.x && p.y < b.upper.y &&
           p.z < b.upper.z;
}

Vec3d way_to_key(const CameraDescription& c)
{
    const Vec3d back = normalize(c.position - c.target), right = normalize(cross(c.up, back));
    return normalize(right * -0.8 + cross(back, right) * 0.8 + back * 0.45);
}

}  // namespace lancer
