#include "app/view/handles.h"

#include <algorithm>
#include <cmath>

#include "app/view/camera_moves.h"
#include "scene/camera.h"

namespace lancer {

std::vector<Handle> handles_of(const SceneDescription& scene, const CameraDescription& camera, PictureSize size,
                               std::optional<size_t> sphere)
{
    // About the camera, so that float holds scenes far from the origin.
    const Camera projection(camera, {.center = camera.position, .scale = 1}, size.width, size.height);
    std::vector<Handle> handles;
    const auto add = [&](Handle::Kind kind, size_t index, Vec3d center, double radius) {
        const Camera::Seen seen = projection.seen(center - camera.position);
        if (!(seen.depth > 0)) return;
        const double pixels = radius / (seen.depth * static_cast<double>(projection.pixel_spread()));
        handles.push_back({kind, index, seen.x / seen.depth, seen.y / seen.depth, std::max(handle_radius, pixels)});
    };
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const LightDescription& l = scene.lights[i];
        if (l.type == LightType::point || l.type == LightType::spot) add(Handle::Kind::light, i, l.position, 0);
        if (l.type == LightType::sphere) add(Handle::Kind::light, i, l.position, l.radius);
    }
    if (sphere && *sphere < scene.spheres.size())
        add(Handle::Kind::sphere, *sphere, scene.spheres[*sphere].center, scene.spheres[*sphere].radius);
    return handles;
}

std::optional<Handle> handle_at(const std::vector<Handle>& handles, double x, double y)
{
    std::optional<Handle> nearest;
    double least = handle_radius;
    for (const Handle& h : handles)
        if (const double d = std::hypot(h.x - x, h.y - y); d <= least) nearest = h, least = d;
    return nearest;
}

}  // namespace lancer
