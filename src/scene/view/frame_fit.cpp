#include "scene/view/frame_fit.h"

namespace lancer {
namespace {

// The extent of points in the directions that the edges of a picture limit: a point (x, y, z), z towards the camera, is
// inside of the right edge of a camera at (cx, cy, d) if x + t z <= cx + t d, where t is the tangent of half the angle.
struct Limits {
    double t_x, t_y;
    double right = -Bounds::inf, left = -Bounds::inf, top = -Bounds::inf, bottom = -Bounds::inf;

    void grow(double x, double y, double z)
    {
        right = std::max(right, t_x * z + x), left = std::max(left, t_x * z - x);
        top = std::max(top, t_y * z + y), bottom = std::max(bottom, t_y * z - y);
    }
    double middle_x() const { return (right - left) / 2; }
    double middle_y() const { return (top - bottom) / 2; }
    // The x, and the y, of a camera at that distance that is nearest to one and sees all; the distance allows one.
    double nearest_x(double x, double d) const { return std::clamp(x, right - t_x * d, t_x * d - left); }
    double nearest_y(double y, double d) const { return std::clamp(y, top - t_y * d, t_y * d - bottom); }
    // The least distance from which a camera somewhere sees all.
    double least_distance() const { return distance(middle_x(), middle_y()); }
    // The least distance from which a camera at (cx, cy) sees all.
    double distance(double cx, double cy) const
    {
        return std::max(std::max(right - cx, left + cx) / t_x, std::max(top - cy, bottom + cy) / t_y);
    }
};

}  // namespace

void fit_to_frame(CameraDescription& c, const Subject& subject, Vec3d back, double aspect, bool fixed_target)
{
    constexpr double of_box = 0.93, most_of_box = 0.945, least = 0.62,
                     whole = 0.98;  // shares of the width or the height
    const Vec3d right = normalize(cross(c.up, back)), up = cross(back, right);
    const double tangent = std::tan(0.5 * c.fov_deg * (pi_d / 180));
    const auto limits = [&](double share) { return Limits{tangent * aspect * share, tangent * share}; };
    Limits outline = limits(least), box = limits(of_box), box_near = limits(most_of_box), box_within = limits(whole);
    const Vec3d size = subject.size();
    const Vec3d origin = fixed_target ? subject.from_file(c.target) : size * 0.5;
    double near = -Bounds::inf, far = Bounds::inf;
    subject.each_point([&](Vec3d p) {
        const Vec3d way = p - origin;
        const double z = dot(way, back);
        outline.grow(dot(way, right), dot(way, up), z);
        near = std::max(near, z), far = std::min(far, z);
    });
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d way = Vec3d{corner & 1 ? size.x : 0, corner & 2 ? size.y : 0, corner & 4 ? size.z : 0} - origin;
        for (Limits* of : {&box, &box_near, &box_within}) of->grow(dot(way, right), dot(way, up), dot(way, back));
    }
    double cx = 0, cy = 0, distance = 0;
    if (fixed_target) {
        distance = box.distance(cx, cy);
    } else {
        // The outline is in the middle as far as the box stays in the picture.
        cx = box.middle_x(), cy = box.middle_y();
        distance = box.distance(cx, cy);
        cx = box_within.nearest_x(outline.middle_x(), distance),
        cy = box_within.nearest_y(outline.middle_y(), distance);
        distance = std::min(distance, std::max(outline.distance(cx, cy), box_near.least_distance()));
    }
    const Vec3d middle = origin + right * cx + up * cy;
    c.position = subject.to_file(middle + back * distance);
    if (!fixed_target) c.target = subject.to_file(middle + back * ((near + far) / 2));
}

}  // namespace lancer
