// Directions relative to what is up: front, right, azimuth and elevation. With y up the front is seen from +z, with z
// up from -y, as modelling programs have it; the right side is seen from +x either way.
#pragma once

#include "core/vec.h"

namespace lancer {

struct UpFrame {
    Vec3d front, right, up;  // unit, perpendicular; towards a viewer in front, to his right, upwards

    // up: finite, not zero.
    explicit UpFrame(Vec3d upwards) : up(normalize(upwards / max_component(abs(upwards))))
    {
        const Vec3d ahead = largest_axis(up) == 2 ? Vec3d{0, -1, 0} : Vec3d{0, 0, 1};
        front = normalize(ahead - up * dot(ahead, up));
        right = cross(up, front);
    }
    // Towards a viewer at these angles: azimuth 0 is in front, 90 on the right side; elevation 90 is above.
    Vec3d towards(double azimuth_deg, double elevation_deg) const
    {
        const double az = azimuth_deg * (pi_d / 180), el = elevation_deg * (pi_d / 180);
        return (front * std::cos(az) + right * std::sin(az)) * std::cos(el) + up * std::sin(el);
    }
    // What is up in the picture for a viewer in that direction: straight above and below, the front is at the bottom,
    // or the top.
    Vec3d upright_from(Vec3d towards_viewer) const
    {
        const double height = dot(towards_viewer, up);
        if (std::abs(height) < 1 - 1e-6) return up;
        return height > 0 ? Vec3d{} - front : front;  // without -0
    }
};

}  // namespace lancer
