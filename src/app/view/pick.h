// What a pixel shows, by one ray.
#pragma once

#include <optional>
#include <string>

#include "render/renderer.h"

namespace lancer {

struct Picked {
    Vec3d point{};                 // in the units of the scene file
    double depth = 0;              // along the view direction, likewise
    std::string object;            // in words
    std::string material;          // its name
    std::optional<size_t> sphere;  // in SceneDescription::spheres
    std::optional<size_t> light;   // a sphere light, in SceneDescription::lights
};

// x, y: in pixels of the full picture. Nothing if the ray hits nothing.
std::optional<Picked> pick(const Renderer& renderer, const SceneDescription& scene, const CameraDescription& camera,
                           PictureSize size, double x, double y);

}  // namespace lancer
