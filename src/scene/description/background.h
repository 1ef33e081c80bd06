// What a scene file says of the background: what is seen where a ray meets nothing. Filled by
// io/scene/background_tables.h, made into scene/environment/background.h.
#pragma once

#include <optional>
#include <string>

#include "core/color.h"
#include "core/error.h"

namespace lancer {

enum class SkyType { color, gradient, night, dawn, dusk, noon, picture };
enum class GroundType { none, color, checker, picture };

// How a picture shows what lies around. The fish-eyes look straight up (a picture of the ground: straight down) and
// differ in the distance from the middle at which they show what lies an angle a off the axis: lachaud 1 - cos a,
// equidistant a, orthographic sin a, equisolid sin a/2. Planar: seen from above, copy beside copy on the ground.
enum class Projection { latlong, lachaud, equidistant, orthographic, equisolid, planar };
constexpr bool is_fish_eye(Projection p) { return p != Projection::latlong && p != Projection::planar; }

struct BackgroundPicture {
    Location where;
    std::string file;
    Projection projection = Projection::latlong;
    double rotate_deg = 0;  // about the axis that points up, counter-clockwise seen from above
    Color scale{1, 1, 1};   // finite, >= 0
    double fov_deg = 180;   // of a fish-eye from rim to rim, in (0, 360]; orthographic: at most 180, lachaud: 180
    double margin = 0;      // pixels between the rim of a fish-eye and the nearest edges, >= 0
    double size = 2;        // planar: side of a copy, in heights of the eye above the ground, > 0
};

struct BackgroundDescription {
    Location where;
    SkyType sky = SkyType::color;
    Color sky_color{};  // radiance, finite, >= 0
    BackgroundPicture sky_picture{};
    GroundType ground = GroundType::none;  // none: the sky goes on below the horizon
    Color ground_color{};
    BackgroundPicture ground_picture{};
    std::optional<Color> fade{};  // what checker and planar pictures pass into; default: the sky at the horizon
    bool z_up = false;            // else y points up
    float strength = 1;           // factor on sky and ground, >= 0
    std::string group{};          // of lights, see scene/lights/groups.h; empty: none
    bool glow = false;            // point and directional lights are seen as discs
};

}  // namespace lancer
