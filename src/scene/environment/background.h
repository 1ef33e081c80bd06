// The background: a sky of colour bands or a picture, a ground below the horizon, and discs that show lights without
// size. Scene adds it to the environment; light sampling uses the table of make_background_table() for both.
#pragma once

#include <memory>
#include <optional>

#include "core/error.h"
#include "materials/textures/texture.h"
#include "scene/description/background.h"
#include "scene/environment/projected_picture.h"

namespace lancer {

struct Scene;
class EnvironmentMap;

class Background {
public:
    // The pictures are those that the description names, else null. legacy: as the ray tracer that --legacy reproduces:
    // the checker is not filtered, and its fish-eye pictures end in grey above the horizon.
    Background(const BackgroundDescription& what, const Raster* sky, const Raster* ground, bool legacy,
               uint32_t texture_limit = 0);

    // Radiance of a ray that leaves the scene towards dir (unit). spread: angle in radians over which the ground's
    // pattern is filtered; 0: not filtered.
    Color eval(Vec3 dir, float spread = 0) const;
    // Whether the background is the same all around at this height, the sine of the elevation.
    bool is_same_around(double height) const;
    // The colour into which a ground fades with distance, without the factor `strength`.
    Color fade() const { return fade_; }

    bool z_up() const { return what_.z_up; }

    const std::optional<ProjectedPicture>& sky_picture() const { return sky_; }
    const std::optional<ProjectedPicture>& ground_picture() const { return ground_; }
    const std::optional<ImageTexture>& ground_plane() const { return plane_; }
    // Number of texels of the pictures that were negative or not finite; they count as black.
    uint64_t bad_texels() const;
    uint64_t bytes() const;  // of the pictures

private:
    Color sky(Vec3d d) const;
    Color ground(Vec3d d, double spread) const;
    Color horizon() const;

    BackgroundDescription what_;
    bool legacy_;
    std::optional<ProjectedPicture> sky_, ground_;
    std::optional<ImageTexture> plane_;
    Color fade_;
};

// Glow: radiance of point and directional lights shown as discs with a radius of four degrees around their direction
// from org. The centre has the light's intensity or irradiance, with a falloff of (1 - degrees / 4)^2. It is visible
// but illuminates nothing.
Color glow_of_lights(const Scene& scene, Vec3 org, Vec3 dir);

// The sampling table of everything at infinity: environment and background together.
std::shared_ptr<const EnvironmentMap> make_background_table(const Scene& scene);

}  // namespace lancer
