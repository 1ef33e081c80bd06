#include "scene/view/turntable.h"

#include "core/transform.h"

namespace lancer {

CameraDescription turned(CameraDescription camera, Vec3d center, Vec3d up, double part)
{
    if (part == 0) return camera;
    const Vec3d x_turned = make_transform({}, {0, 360 * part, 0}, {1, 1, 1}).x;
    const double cosine = x_turned.x, sine = -x_turned.z;
    const auto turn = [&](Vec3d v) {
        const Vec3d along = up * dot(v, up);
        return along + (v - along) * cosine + cross(up, v) * sine;
    };
    camera.position = center + turn(camera.position - center);
    camera.target = center + turn(camera.target - center);
    camera.up = turn(camera.up);
    return camera;
}

}  // namespace lancer
