// From a point on the film to a ray. Pharr, Jakob, Humphreys, 4th ed., chapter 5.
#pragma once

#include "core/bounds.h"
#include "core/ray.h"
#include "scene/description/description.h"
#include "scene/scene.h"

namespace lancer {

// Where on the film the middle of a pixel lies.
enum class PixelGrid {
    centres,  // in the middle of its square
    shifted,  // one row lower, so that the picture stands one row too high: as in the student's path tracer
    corners,  // the first and the last of each row and column on the edge: as in the course's ray tracer
};

// A pinhole, or a thin lens where aperture is not 0.
class Camera {
public:
    // size: of the whole picture, pixels.
    Camera(const CameraDescription& description, const Normalisation& normalisation, uint32_t width, uint32_t height,
           PixelGrid grid = PixelGrid::centres);

    // film: in pixels, x to the right, y down from the upper left corner; lens: in [0, 1)^2.
    Ray ray(Vec2 film, Vec2 lens) const;
    // The same through the middle of the lens: all that a pinhole has.
    Ray middle_ray(Vec2 film) const { return {.org = position_, .dir = normalize(direction(film.x, film.y))}; }
    // The directions of eight of these; they start at position().
    Vec3x8 middle_directions(const Vec2x8& film) const { return normalize(direction(film.x, film.y)); }
    // Width of a pixel at distance 1.
    float pixel_spread() const { return length(right_); }

    bool is_pinhole() const { return lens_right_ == Vec3{}; }
    Vec3 position() const { return position_; }
    // A place as a pinhole sees it: it lies at (x / depth, y / depth) of the film, in pixels, where depth > 0.
    struct Seen {
        double x, y, depth;
    };
    Seen seen(Vec3d p) const { return seen_along(p - to_double(position_)); }
    // Of the way there from the camera, in which it is linear.
    Seen seen_along(Vec3d way) const;

    friend bool operator==(const Camera&, const Camera&) = default;

private:
    // Through the middle of the lens; 1 long along the way that the camera looks.
    template <class T>
    Vec3T<T> direction(T x, T y) const
    {
        const Vec3T<T> across = broadcast_to<T>(right_) * (x - centre_.x),
                       down = broadcast_to<T>(down_) * (y - centre_.y);
        return broadcast_to<T>(forward_) + across + down;
    }

    Vec3 position_, right_, down_, forward_;  // right_, down_: one pixel at distance 1
    Vec3 lens_right_, lens_up_;               // radius of the lens; 0 for a pinhole
    Vec2 centre_;                             // of the film, pixels
    float focus_;                             // distance of the plane in focus
};

// Looks at the whole of the subject from the front, a little from above. aspect: width over height.
CameraDescription fit_camera(const Bounds& subject, double aspect);

// A sky and a sun from the upper left, for a subject that brings no light; it is as bright as its albedo, or so.
std::vector<LightDescription> default_lights(const Bounds& subject);

}  // namespace lancer
