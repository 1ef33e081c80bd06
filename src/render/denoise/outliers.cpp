#include "render/denoise/outliers.h"

#include <algorithm>

namespace lancer::denoise {
namespace {

constexpr int near = 2;       // pixels to each side that are compared
constexpr int spread = 7;     // pixels to each side that light is spread over
constexpr float much = 2.0f;  // an outlier exceeds the brightest pixel near it by this factor

Plane luminance_of(const ColorPlanes& color)
{
    Plane out(color[0].width(), color[0].height());
    for_rows(out.height(), [&](int y) {
        for (int x = 0; x < out.width(); ++x)
            out.row(y)[x] = luminance({color[0].row(y)[x], color[1].row(y)[x], color[2].row(y)[x]});
    });
    out.mirror_edges();
    return out;
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
    Plane kept(own.width(), own.height());
    for_rows(own.height(), [&](int y) {
        for (int x = 0; x < own.width(); ++x) {
            const float limit = brightest_near(other, x, y), v = own.row(y)[x];
            kept.row(y)[x] = v > much * limit ? limit / v : 1.0f;
        }
    });
    return kept;
}

void spread_rest(Plane& plane, const Plane& kept)
{
    Plane rest(plane.width(), plane.height());
    for_rows(plane.height(), [&](int y) {
        for (int x = 0; x < plane.width(); ++x) {
            const float v = plane.row(y)[x], k = kept.row(y)[x];
            plane.row(y)[x] = v * k, rest.row(y)[x] = v * (1 - k);
        }
    });
    rest.mirror_edges();
    const Plane even = box_mean(rest, spread);
    for_rows(plane.height(), [&](int y) {
        for (int x = 0; x < plane.width(); ++x) plane.row(y)[x] += even.row(y)[x];
    });
    plane.mirror_edges();
}

}  // namespace

void spread_outliers(Halves& halves)
{
    auto& [a, b] = halves.half;
    const Plane of_a = luminance_of(a.color), of_b = luminance_of(b.color);
    const Plane kept_a = kept_part(of_a, of_b), kept_b = kept_part(of_b, of_a);
    for (Plane& p : a.color) spread_rest(p, kept_a);
    for (Plane& p : b.color) spread_rest(p, kept_b);
    Plane& variance = halves.pixel_variance;
    for_rows(variance.height(), [&](int y) {
        for (int x = 0; x < variance.width(); ++x) {
            const float kept = std::min(kept_a.row(y)[x], kept_b.row(y)[x]);
            variance.row(y)[x] *= kept * kept;
        }
    });
    variance.mirror_edges();
}

}  // namespace lancer::denoise
