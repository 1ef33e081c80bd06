#include "app/view/camera_moves.h"

#include <algorithm>
#include <cmath>

#include "app/console.h"
#include "app/defaults/toml_text.h"
#include "core/warp.h"

namespace lancer {
namespace {

constexpr double radians = pi_d / 180;
constexpr double steepest_rad = 89 * radians;

// The offset turned about `up` and raised; it keeps its length.
Vec3d turned_about(Vec3d offset, Vec3d up, double right_rad, double up_rad, Vec3d fallback)
{
    const double far = length(offset), height = dot(offset, up);
    Vec3d flat = offset - up * height;
    // Straight above, the picture tells where it is going.
    if (length(flat) < 1e-6 * far) flat = fallback - up * dot(fallback, up);
    const Vec3d ahead = normalize(flat), aside = cross(up, ahead);
    const double elevation =
        std::clamp(std::asin(std::clamp(height / far, -1.0, 1.0)) + up_rad, -steepest_rad, steepest_rad);
    const Vec3d around = ahead * std::cos(right_rad) + aside * std::sin(right_rad);
    return (around * std::cos(elevation) + up * std::sin(elevation)) * far;
}

double height_at(const CameraDescription& camera, double depth)
{
    return 2 * std::tan(0.5 * camera.fov_deg * radians) * depth;
}

}  // namespace

bool is_same_view(const CameraDescription& a, const CameraDescription& b)
{
    return a.type == b.type && a.position == b.position && a.target == b.target && a.up == b.up &&
           a.fov_deg == b.fov_deg && a.aperture == b.aperture && a.focus == b.focus;
}

ViewAxes axes_of(const CameraDescription& camera)
{
    const Vec3d forward = normalize(camera.target - camera.position), right = normalize(cross(forward, camera.up));
    return {right, cross(right, forward), forward};
}

CameraDescription orbited(CameraDescription c, double right_rad, double up_rad)
{
    const Vec3d up = normalize(c.up);
    c.position = c.target + turned_about(c.position - c.target, up, right_rad, up_rad, -axes_of(c).up);
    return c;
}

CameraDescription turned(CameraDescription c, double right_rad, double up_rad)
{
    const Vec3d up = normalize(c.up);
    c.target = c.position + turned_about(c.target - c.position, up, -right_rad, up_rad, axes_of(c).up);
    return c;
}

CameraDescription panned(CameraDescription c, double right, double up)
{
    const Vec3d to = moved_in_view(c, c.target, right, up);
    c.position += to - c.target;
    c.target = to;
    return c;
}

CameraDescription dollied(CameraDescription c, double factor)
{
    c.position = c.target + (c.position - c.target) * factor;
    return c;
}

CameraDescription flown(CameraDescription c, Vec3d step)
{
    const ViewAxes axes = axes_of(c);
    const Vec3d way = axes.right * step.x + axes.up * step.y + axes.forward * step.z;
    c.position += way;
    c.target += way;
    return c;
}

CameraDescription seen_along(CameraDescription c, Vec3d forward)
{
    c.position = c.target - normalize(forward) * length(c.target - c.position);
    return c;
}

CameraDescription centred(CameraDescription c, Vec3d target)
{
    c.position += target - c.target;
    c.target = target;
    return c;
}

double depth_of(const CameraDescription& camera, Vec3d point)
{
    return dot(point - camera.position, axes_of(camera).forward);
}

Vec3d moved_in_view(const CameraDescription& camera, Vec3d point, double right, double up)
{
    const ViewAxes axes = axes_of(camera);
    const double height = height_at(camera, depth_of(camera, point));
    return point + axes.right * (right * height) + axes.up * (up * height);
}

Vec3d moved_along_view(const CameraDescription& camera, Vec3d point, double part)
{
    return point + axes_of(camera).forward * (part * depth_of(camera, point));
}

std::string camera_table(const CameraDescription& c, const std::string& name)
{
    std::string text = name.empty() ? "[camera]\n" : "[camera." + name + "]\n";
    text += "position = " + to_toml(c.position) + "\ntarget = " + to_toml(c.target) + "\nup = " + to_toml(c.up) +
            "\nfov = " + shortest(c.fov_deg) + "\n";
    if (c.type == CameraType::thin_lens) {
        text += "type = \"thin_lens\"\naperture = " + shortest(c.aperture) + "\n";
        if (c.focus) text += "focus = " + shortest(*c.focus) + "\n";
    }
    return text;
}

}  // namespace lancer
