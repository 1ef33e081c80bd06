#include "io/shared_mesh.h"

#include <algorithm>
#include <cmath>

namespace lancer {
namespace {

double largest_difference(const Transform& a, const Transform& b)
{
    return std::max({max_component(abs(a.x - b.x)), max_component(abs(a.y - b.y)), max_component(abs(a.z - b.z))});
}

// Degrees about x, then y, then z of a rotation, whose columns are unit.
Vec3d angles_of(const Transform& r)
{
    constexpr double upright = 1e-9;  // beyond, turns about x and z are the same
    const double cos_y = std::hypot(r.x.x, r.x.y), y = std::atan2(-r.x.z, cos_y);
    const double x = cos_y > upright ? std::atan2(r.y.z, r.z.z) : std::atan2(-r.z.y, r.y.y);
    const double z = cos_y > upright ? std::atan2(r.x.y, r.x.x) : 0;
    return Vec3d{x, y, z} * (180 / pi_d);
}

}  // namespace

std::optional<TransformDescription> parts_of(const Transform& map)
{
    const double side = map.determinant() < 0 ? -1 : 1;
    const Vec3d scale{side * length(map.x), length(map.y), length(map.z)};
    const double most = max_component(abs(scale));
    if (!(std::min({std::abs(scale.x), scale.y, scale.z}) > 0) || !std::isfinite(most)) return {};
    const Transform turn{map.x / scale.x, map.y / scale.y, map.z / scale.z, {}};
    const TransformDescription parts{.translate = map.translation, .rotate_deg = angles_of(turn), .scale = scale};
    const Transform made = make_transform(parts.translate, parts.rotate_deg, parts.scale);
    constexpr double tolerance = 1e-12;
    if (!(largest_difference(made, map) <= tolerance * most)) return {};
    return parts;
}

}  // namespace lancer
