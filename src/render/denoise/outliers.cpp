#include "render/denoise/outliers.h"

#include <algorithm>

namespace lancer::denoise {
namespace {

constexpr int near = 2;       // pixels to each side that are compared
constexpr int spread = 7;     // pixels to each side that light is spread over
constexpr float much = 2.0f;  // an outlier exceeds the brightest pixel near it by this factor

Plane luminance_of(const ColorPlanes& color)
{
    return plane_of(color[0].width(), color[0].height(), [&](int x, int y) {
        return luminance({color[0].row(y)[x], color[1].row(y)[x], color[2].row(y)[x]});
    });
}

float brightest_near(const Plane& plane, int x, int y)
{
    float most = 0;
    for (int dy = -near; dy <= near; ++dy) {
        const float* const row = plane.row(y + dy) + x;
        most = std::max(most, *std::max_element(row - near, row + near + 1));
    }
    return most;
}

// The part of each pixel's light that it keeps.
Plane kept_part(const Plane& own, const Plane& other)
{
    return plane_of(own.width(), own.height(), [&](int x, int y) {
        const float limit = brightest_near(other, x, y), v = own.row(y)[x];
        return v > much * limit ? limit / v : 1.0f;
    });
}

Plane with_rest_spread(const Plane& plane, const Plane& kept)
{
    const Plane rest =
        plane_of(plane.width(), plane.height(), [&](int x, int y) { return plane.row(y)[x] * (1 - kept.row(y)[x]); });
    const Plane even = box_mean(rest, spread);
    return plane_of(plane.width(), plane.height(),
                    [&](int x, int y) { return plane.row(y)[x] * kept.row(y)[x] + even.row(y)[x]; });
}

}  // namespace

void spread_outliers(Halves& halves)
{
    auto& [a, b] = halves.half;
    const Plane of_a = luminance_of(a.color), of_b = luminance_of(b.color);
    const Plane kept_a = kept_part(of_a, of_b), kept_b = kept_part(of_b, of_a);
    for (Plane& p : a.color) p = with_rest_spread(p, kept_a);
    for (Plane& p : b.color) p = with_rest_spread(p, kept_b);
    const Plane& variance = halves.pixel_variance;
    halves.pixel_variance = plane_of(variance.width(), variance.height(), [&](int x, int y) {
        const float kept = std::min(kept_a.row(y)[x], kept_b.row(y)[x]);
        return variance.row(y)[x] * (kept * kept);
    });
}

}  // namespace lancer::denoise
