// What is seen where a ray meets nothing: a sky of bands or of a picture, a ground below the horizon, and the discs as
// which lights without size can be shown. Called by Scene, which adds it to the environment; light sampling draws it by
// a table that make_background_table() makes of both.
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
    // The pictures are those that the description names, else null. legacy: as the course's ray tracer has it: the
    // checker is not filtered, and fish-eyes of its kind end in grey above the horizon.
    Background(const BackgroundDescription& what, const Raster* sky, const Raster* ground, bool legacy);

    // Radiance that arrives along a ray that leaves the scene towards dir (unit). spread: angle, in radians, over which
    // the pattern of the ground is averaged; 0: not at all.
    Color eval(Vec3 dir, float spread = 0) const;
    // Whether all directions of this height, the sine of their elevation, look the same (but for their spread).
    bool is_same_around(double height) const;
    // What a ground passes into with distance, without the factor `strength`.
    Color fade() const { return fade_; }

    bool z_up() const { return what_.z_up; }

    const std::optional<ProjectedPicture>& sky_picture() const { return sky_; }
    const std::optional<ProjectedPicture>& ground_picture() const { return ground_; }
    const std::optional<ImageTexture>& ground_plane() const { return plane_; }
    // Texels of the pictures that had something negative, or no finite number: that counts as black.
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

// How bright the lights without size are as discs: each of a radius of four degrees around the direction in which it
// is seen from org, as bright in its middle as its intensity or irradiance says, falling off with (1 - degrees / 4)^2.
// No physical light: it is seen and lights nothing.
Color glow_of_lights(const Scene& scene, Vec3 org, Vec3 dir);

// By what light sampling draws everything that lies infinitely far away: environment and background together.
std::shared_ptr<const EnvironmentMap> make_background_table(const Scene& scene);

// Waits for the pictures of the background, makes Scene::background of them and, after receive_environment(), the
// table. What cannot be read is an error.
void receive_background(Scene& scene, Diagnostics& diagnostics);

}  // namespace lancer
