#include "scene/environment/projected_picture.h"

#include <algorithm>
#include <cmath>

namespace lancer {

uint64_t blacken_bad_texels(Image& image)
{
    uint64_t bad = 0;
    for (Color& c : image.pixels) {
        // std::max keeps its first argument where the other is not a number.
        const Color kept =
            is_finite(c) ? Color{std::max(0.0f, c.r), std::max(0.0f, c.g), std::max(0.0f, c.b)} : Color{};
        bad += !(kept == c);
        c = kept;
    }
    return bad;
}

ProjectedPicture::ProjectedPicture(const BackgroundPicture& how, const Raster& picture)
    : projection_(how.projection),
      half_fov_(how.fov_deg * pi_d / 360),
      sin_rotation_(std::sin(how.rotate_deg * pi_d / 180)),
      cos_rotation_(std::cos(how.rotate_deg * pi_d / 180)),
      image_(to_image(picture, Encoding::of_file))
{
    radius_ = std::max(0.0, std::min(width(), height()) / 2.0 - how.margin);
    for (Color& c : image_.pixels) c *= how.scale;
    bad_ = blacken_bad_texels(image_);
}

double ProjectedPicture::pixels_per_radian() const
{
    return projection_ == Projection::latlong ? std::max(width() / (2 * pi_d), height() / pi_d)
                                              : 2 * radius_ / half_fov_;
}

// Distance from the middle of a fish-eye, of which the rim has 1.
double ProjectedPicture::from_axis(Vec3d d) const
{
    const double across = std::hypot(d.x, d.y), angle = std::min(std::atan2(across, d.z), half_fov_);
    switch (projection_) {
        // The formula of the course, which knows nothing below the horizon.
        case Projection::lachaud:
            return d.z < 0 ? 1 : std::max(0.0, 1 - std::sqrt(std::max(0.0, 1 - across * across)));
        case Projection::orthographic:
            return std::sin(angle) / std::sin(half_fov_);
        case Projection::equisolid:
            return std::sin(angle / 2) / std::sin(half_fov_ / 2);
        default:
            return angle / half_fov_;
    }
}

ProjectedPicture::Place ProjectedPicture::place_of(Vec3d d) const
{
    const double x = cos_rotation_ * d.x + sin_rotation_ * d.y, y = cos_rotation_ * d.y - sin_rotation_ * d.x;
    if (projection_ == Projection::latlong)
        return {(0.5 - std::atan2(x, -y) / (2 * pi_d)) * width(), std::atan2(std::hypot(x, y), d.z) / pi_d * height()};
    const double across = std::hypot(x, y), r = across > 0 ? radius_ * from_axis(d) / across : 0;
    return {width() / 2.0 + r * x, height() / 2.0 + r * y};
}

Color ProjectedPicture::eval(Vec3d d) const
{
    const Place p = place_of(d);
    const double left = std::floor(p.x - 0.5), top = std::floor(p.y - 0.5);
    const auto x = static_cast<float>(p.x - 0.5 - left), y = static_cast<float>(p.y - 0.5 - top);
    const bool wraps = projection_ == Projection::latlong;
    const auto column = [&](double i) {
        const auto c = static_cast<int32_t>(i);
        if (wraps) return c < 0 ? width() - 1 : c >= width() ? 0 : c;
        return std::clamp(c, 0, width() - 1);
    };
    const auto row = [&](double i) { return std::clamp(static_cast<int32_t>(i), 0, height() - 1); };
    const int32_t x0 = column(left), x1 = column(left + 1), y0 = row(top), y1 = row(top + 1);
    return mix(mix(image_.at(x0, y0), image_.at(x1, y0), x), mix(image_.at(x0, y1), image_.at(x1, y1), x), y);
}

}  // namespace lancer
