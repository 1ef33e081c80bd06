// Cameras: generate a ray from a film position. Pharr, Jakob, Humphreys, 4th ed., chapter 5.
#pragma once

#include <vector>

#include "core/bounds.h"
#include "core/ray.h"
#include "scene/description/description.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace lancer {

// Position of pixel centres on the film.
enum class PixelGrid {
    centres,  // at the centres of their squares
    shifted,  // one row lower, as in the path tracer that --legacy reproduces
    corners,  // the outermost ones on the edges of the film, as in the ray tracer that --legacy reproduces
};

// A pinhole camera, or a thin-lens camera if aperture is not 0. It may move while its shutter is open; all that does
// not ask for a time is of the opening.
class Camera {
public:
    // size: of the whole picture, pixels.
    Camera(const CameraDescription& description, const Normalisation& normalisation, uint32_t width, uint32_t height,
           PixelGrid grid = PixelGrid::centres);
    // That of a scene, which has one, with its SceneDescription::camera_path.
    Camera(const SceneDescription& scene, const Normalisation& normalisation, uint32_t width, uint32_t height,
           PixelGrid grid = PixelGrid::centres);

    // film: in pixels, x to the right, y down from the upper left corner; lens: in [0, 1)^2; time: in [0, 1) between
    // the shutter's opening and its closing.
    Ray ray(Vec2 film, Vec2 lens, float time = 0) const;
    // The ray through the centre of the lens.
    Ray middle_ray(Vec2 film) const
    {
        return {.org = open_.position, .dir = normalize(direction(open_, film.x, film.y))};
    }
    // Directions of eight such rays; their origin is position().
    Vec3x8 middle_directions(const Vec2x8& film) const { return normalize(direction(open_, film.x, film.y)); }
    // Width of a pixel at distance 1.
    float pixel_spread() const { return length(open_.right); }
    // Of each camera ray. It is narrower than the pixel, whose samples average the texture over all of it: a footprint
    // as wide as the pixel blurs twice, and at grazing angles its square is wider still.
    RayCone cone() const { return {0, pixel_spread() / 8}; }

    bool is_still() const { return path_.empty(); }
    bool is_pinhole() const { return open_.lens_right == Vec3{}; }  // of one that moves: as its shutter opens
    Vec3 position() const { return open_.position; }
    // Projection of a point: it lies at (x / depth, y / depth) of the film, in pixels, where depth > 0.
    struct Seen {
        double x, y, depth;
    };
    Seen seen(Vec3d p) const { return seen_along(p - to_double(open_.position)); }
    // Projection of a vector from the camera; linear in it.
    Seen seen_along(Vec3d way) const;

    friend bool operator==(const Camera&, const Camera&) = default;

    // Its direction, unit.
    Vec3 axis() const { return open_.forward; }

private:
    struct Pose {
        Vec3 position, right, down, forward;  // right, down: one pixel at distance 1
        Vec3 lens_right, lens_up;             // radius of the lens; 0 for a pinhole
        float focus;                          // distance of the plane in focus

        friend bool operator==(const Pose&, const Pose&) = default;
    };
    static Pose pose_of(const CameraDescription& c, const Normalisation& normalisation, uint32_t width, uint32_t height,
                        PixelGrid grid);
    Pose pose_at(float time) const;
    Ray ray_from(const Pose& pose, Vec2 film, Vec2 lens) const;
    // Direction through the centre of the lens, with length 1 along the optical axis.
    template <class T>
    Vec3T<T> direction(const Pose& pose, T x, T y) const
    {
        const Vec3T<T> across = broadcast_to<T>(pose.right) * (x - centre_.x),
                       down = broadcast_to<T>(pose.down) * (y - centre_.y);
        return broadcast_to<T>(pose.forward) + across + down;
    }

    Pose open_;               // as the shutter opens
    std::vector<Pose> path_;  // at even steps of time, from there on; empty: it stands still
    Vec2 centre_;             // of the film, pixels
};

// A camera that sees the whole subject from the front and slightly from above. aspect: width over height.
CameraDescription fit_camera(const Bounds& subject, double aspect);

}  // namespace lancer
