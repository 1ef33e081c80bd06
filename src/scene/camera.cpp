#include "scene/camera.h"

#include "core/warp.h"

namespace lancer {
namespace {

constexpr double to_rad = pi_d / 180;

}  // namespace

Camera::Camera(const CameraDescription& c, const Normalisation& normalisation, uint32_t width, uint32_t height,
               PixelGrid grid)
{
    const Vec3d eye = normalisation.to_scene(c.position), target = normalisation.to_scene(c.target);
    const Vec3d forward = normalize(target - eye), right = normalize(cross(forward, c.up)), up = cross(right, forward);
    const double pixel = 2 * std::tan(0.5 * c.fov_deg * to_rad) / height;
    position_ = to_float(eye);
    forward_ = to_float(forward);
    // From edge to edge there is one step less than pixels.
    const auto stretch = [&](uint32_t count) {
        return grid == PixelGrid::corners && count > 1 ? static_cast<double>(count) / (count - 1) : 1;
    };
    right_ = to_float(right * (pixel * stretch(width)));
    down_ = to_float(up * (-pixel * stretch(height)));
    centre_ = {0.5f * static_cast<float>(width),
               0.5f * static_cast<float>(height) + (grid == PixelGrid::shifted ? 1.0f : 0.0f)};
    const double radius = c.type == CameraType::thin_lens ? c.aperture * normalisation.scale : 0;
    lens_right_ = to_float(right * radius);
    lens_up_ = to_float(up * radius);
    focus_ = static_cast<float>(c.focus ? *c.focus * normalisation.scale : length(target - eye));
}

Ray Camera::ray(Vec2 film, Vec2 lens) const
{
    if (is_pinhole()) return middle_ray(film);
    const Vec3 d = direction(film.x, film.y);
    // All rays through one film point meet where the plane in focus cuts the ray through the lens' centre.
    const Vec2 disk = square_to_disk(lens);
    const Vec3 on_lens = lens_right_ * disk.x + lens_up_ * disk.y;
    return {.org = position_ + on_lens, .dir = normalize(d * focus_ - on_lens)};
}

Camera::Seen Camera::seen_along(Vec3d d) const
{
    const Vec3d right = to_double(right_), down = to_double(down_);
    const double depth = dot(d, to_double(forward_));
    return {dot(d, right) / dot(right, right) + static_cast<double>(centre_.x) * depth,
            dot(d, down) / dot(down, down) + static_cast<double>(centre_.y) * depth, depth};
}

CameraDescription fit_camera(const Bounds& subject, double aspect)
{
    constexpr double margin = 0.9;  // of the picture that the subject may fill
    CameraDescription c;
    const Bounds b = subject.extent() > 0 ? subject : Bounds{{-1, -1, -1}, {1, 1, 1}};
    const Vec3d back = normalize(Vec3d{0.35, 0.3, 1}), right = normalize(cross(c.up, back)), up = cross(back, right);
    const double tan_y = std::tan(0.5 * c.fov_deg * to_rad) * margin, tan_x = tan_y * aspect;
    // Far enough back for each corner of the box.
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d p = Vec3d{corner & 1 ? b.upper.x : b.lower.x, corner & 2 ? b.upper.y : b.lower.y,
                              corner & 4 ? b.upper.z : b.lower.z} -
                        b.center();
        const double across = std::max(std::abs(dot(p, right)) / tan_x, std::abs(dot(p, up)) / tan_y);
        distance = std::max(distance, dot(p, back) + across);
    }
    c.target = subject.empty() ? Vec3d{} : subject.center();
    c.position = c.target + back * distance;
    return c;
}

}  // namespace lancer
