#include "scene/camera.h"

#include <algorithm>

#include "core/warp.h"

namespace lancer {
namespace {

constexpr double to_rad = pi_d / 180;

}  // namespace

Camera::Pose Camera::pose_of(const CameraDescription& c, const Normalisation& normalisation, uint32_t width,
                             uint32_t height, PixelGrid grid)
{
    const Vec3d eye = normalisation.to_scene(c.position), target = normalisation.to_scene(c.target);
    const Vec3d forward = normalize(target - eye), right = normalize(cross(forward, c.up)), up = cross(right, forward);
    const double pixel = 2 * std::tan(0.5 * c.fov_deg * to_rad) / height;
    // From edge to edge there is one step less than pixels.
    const auto stretch = [&](uint32_t count) {
        return grid == PixelGrid::corners && count > 1 ? static_cast<double>(count) / (count - 1) : 1;
    };
    const double radius = c.type == CameraType::thin_lens ? c.aperture * normalisation.scale : 0;
    return {.position = to_float(eye),
            .right = to_float(right * (pixel * stretch(width))),
            .down = to_float(up * (-pixel * stretch(height))),
            .forward = to_float(forward),
            .lens_right = to_float(right * radius),
            .lens_up = to_float(up * radius),
            .focus = static_cast<float>(c.focus ? *c.focus * normalisation.scale : length(target - eye))};
}

Camera::Camera(const CameraDescription& c, const Normalisation& normalisation, uint32_t width, uint32_t height,
               PixelGrid grid)
    : open_(pose_of(c, normalisation, width, height, grid)),
      centre_{0.5f * static_cast<float>(width),
              0.5f * static_cast<float>(height) + (grid == PixelGrid::shifted ? 1.0f : 0.0f)}
{
}

Camera::Camera(const SceneDescription& scene, const Normalisation& normalisation, uint32_t width, uint32_t height,
               PixelGrid grid)
    : Camera(*scene.camera, normalisation, width, height, grid)
{
    for (const CameraDescription& c : scene.camera_path)
        path_.push_back(pose_of(c, normalisation, width, height, grid));
}

// Straight from pose to pose: a turn between them is so small that its chord serves.
Camera::Pose Camera::pose_at(float time) const
{
    const auto steps = path_.size() - 1;
    const float x = time * static_cast<float>(steps);
    const size_t i = std::min(steps - 1, static_cast<size_t>(x));
    const float part = x - static_cast<float>(i);
    const Pose &a = path_[i], &b = path_[i + 1];
    const auto between = [&](const auto& from, const auto& to) { return from + (to - from) * part; };
    return {.position = between(a.position, b.position),
            .right = between(a.right, b.right),
            .down = between(a.down, b.down),
            .forward = between(a.forward, b.forward),
            .lens_right = between(a.lens_right, b.lens_right),
            .lens_up = between(a.lens_up, b.lens_up),
            .focus = between(a.focus, b.focus)};
}

Ray Camera::ray(Vec2 film, Vec2 lens, float time) const
{
    return is_still() ? ray_from(open_, film, lens) : ray_from(pose_at(time), film, lens);
}

Ray Camera::ray_from(const Pose& pose, Vec2 film, Vec2 lens) const
{
    const Vec3 d = direction(pose, film.x, film.y);
    if (pose.lens_right == Vec3{}) return {.org = pose.position, .dir = normalize(d)};
    // All rays through one film point meet where the plane in focus cuts the ray through the lens' centre.
    const Vec2 disk = square_to_disk(lens);
    const Vec3 on_lens = pose.lens_right * disk.x + pose.lens_up * disk.y;
    return {.org = pose.position + on_lens, .dir = normalize(d * pose.focus - on_lens)};
}

Camera::Seen Camera::seen_along(Vec3d d) const
{
    const Vec3d right = to_double(open_.right), down = to_double(open_.down);
    const double depth = dot(d, to_double(open_.forward));
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
