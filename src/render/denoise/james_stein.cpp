#include "render/denoise/james_stein.h"

namespace lancer::denoise {
namespace {

// What a squared difference at a pixel counts: errors are relative to the light around, else the edge of a lamp would
// decide for all pixels near it.
Plane weights_of(const Plane& noisy)
{
    constexpr int around = 1;
    constexpr float black = 0.01f;  // as in the relative mean squared error
    const Plane light = box_mean(noisy, around);
    return plane_of(light.width(), light.height(), [&](int x, int y) {
        const float l = light.row(y)[x];
        return 1 / (l * l + black);
    });
}

}  // namespace

Plane noisy_part(const Plane& filtered, const Plane& noisy, const Plane& variance)
{
    const int width = filtered.width(), height = filtered.height();
    const Plane weight = weights_of(noisy);
    const Plane squares = plane_of(width, height, [&](int x, int y) {
        const float difference = noisy.row(y)[x] - filtered.row(y)[x];
        return weight.row(y)[x] * difference * difference;
    });
    const Plane own = plane_of(width, height, [&](int x, int y) { return weight.row(y)[x] * variance.row(y)[x]; });
    const Plane apart = box_mean(squares, blend_radius), noise = box_mean(own, blend_radius);
    return plane_of(width, height, [&](int x, int y) {
        const float d = apart.row(y)[x], n = noise.row(y)[x];
        return d > n ? 1 - n / d : 0.0f;
    });
}

}  // namespace lancer::denoise
