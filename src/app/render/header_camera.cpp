#include "app/render/header_camera.h"

namespace lancer {

ExrCamera header_camera(const Camera& camera, const Normalisation& normalisation, uint32_t width, uint32_t height)
{
    // The projection is linear in the way from the camera: three axes tell all of it.
    const Camera::Seen s[] = {camera.seen_along({1, 0, 0}), camera.seen_along({0, 1, 0}), camera.seen_along({0, 0, 1})};
    const Vec3d x{s[0].x, s[1].x, s[2].x}, y{s[0].y, s[1].y, s[2].y}, forward{s[0].depth, s[1].depth, s[2].depth};
    // Without what the middle of the film adds to them, which is along the optical axis.
    const Vec3d right = normalize(x - forward * dot(x, forward)), down = normalize(y - forward * dot(y, forward));
    const Vec3d eye = normalisation.to_file(to_double(camera.position()));
    // For z = 1 - 1 / w, which is 0 at distance 1 and 1 at infinity, so that the matrix has an inverse.
    const Vec3d to_camera[] = {right, -down, forward};
    const Vec3d to_ndc[] = {x / static_cast<double>(width), y / static_cast<double>(height), forward, forward};
    const double moved[] = {0, 0, -1, 0};
    ExrCamera header;
    const auto set_column = [](ExrCamera::Matrix& m, size_t column, Vec3d v, double last) {
        const double values[] = {v.x, v.y, v.z, last};
        for (size_t row = 0; row < 4; ++row) m[row][column] = static_cast<float>(values[row]);
    };
    for (size_t i = 0; i < 3; ++i) set_column(header.world_to_camera, i, to_camera[i], -dot(to_camera[i], eye));
    set_column(header.world_to_camera, 3, {}, 1);
    for (size_t i = 0; i < 4; ++i) set_column(header.world_to_ndc, i, to_ndc[i], moved[i] - dot(to_ndc[i], eye));
    return header;
}

}  // namespace lancer
