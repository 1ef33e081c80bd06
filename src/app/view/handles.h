// Handles of lights over the picture: where they are, and which one a mouse is at. Lights at infinity have none.
#pragma once

#include <optional>
#include <vector>

#include "scene/description/description.h"

namespace lancer {

struct Handle {
    enum class Kind { light, sphere } kind = Kind::light;
    size_t index = 0;  // in lights or spheres of the description
    double x = 0, y = 0,
           radius = 0;  // in pixels of the picture; radius: that a sphere has there, at least that of a dot
    friend bool operator==(const Handle& a, const Handle& b) { return a.kind == b.kind && a.index == b.index; }
};

inline constexpr double handle_radius = 8;  // pixels

// Those in front of the camera, of lights with a place, and of one sphere if it is selected.
std::vector<Handle> handles_of(const SceneDescription& scene, const CameraDescription& camera, PictureSize size,
                               std::optional<size_t> sphere = {});
// The nearest whose dot the point is in.
std::optional<Handle> handle_at(const std::vector<Handle>& handles, double x, double y);

}  // namespace lancer
