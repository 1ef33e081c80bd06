#include "render/denoise/james_stein.h"

namespace lancer::denoise {
namespace {

// What a squared difference at a pixel counts: errors are relative to the light around, else the edge of a lamp would
// decide for all pixels near it.
Plane weights_of(const Plane& noisy)
{
    constexpr int around = 1;
    constexpr float black = 0.01f;  // as in the relative mean squared error
    Plane weight = box_mean(noisy, around);
    for_rows(weight.height(), [&](int y) {
        for (int x = 0; x < weight.width(); ++x) {
            float& w = weight.row(y)[x];
            w = 1 / (w * w + black);
        }
    });
    return weight;
}

}  // namespace

Plane noisy_part(const Plane& filtered, const Plane& noisy, const Plane& variance)
{
    const Plane weight = weights_of(noisy);
    Plane squares(filtered.width(), filtered.height()), noise(filtered.width(), filtered.height());
    for_rows(squares.height(), [&](int y) {
        for (int x = 0; x < squares.width(); ++x) {
            const float difference = noisy.row(y)[x] - filtered.row(y)[x], w = weight.row(y)[x];
            squares.row(y)[x] = w * difference * difference;
            noise.row(y)[x] = w * variance.row(y)[x];
        }
    });
    squares.mirror_edges(), noise.mirror_edges();
    Plane part = box_mean(squares, blend_radius);
    noise = box_mean(noise, blend_radius);
    for_rows(part.height(), [&](int y) {
        for (int x = 0; x < part.width(); ++x) {
            const float d = part.row(y)[x], n = noise.row(y)[x];
            part.row(y)[x] = d > n ? 1 - n / d : 0.0f;
        }
    });
    return part;
}

}  // namespace lancer::denoise
