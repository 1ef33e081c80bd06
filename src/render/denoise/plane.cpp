#include "render/denoise/plane.h"

#include <algorithm>

#include "core/lanes/lanes.h"
#include "core/parallel.h"

namespace lancer::denoise {
namespace {

// The pixel of [0, n) whose mirror image i is; the images repeat with period 2n.
int mirrored(int i, int n)
{
    const int m = ((i % (2 * n)) + 2 * n) % (2 * n);
    return m < n ? m : 2 * n - 1 - m;
}

}  // namespace

Plane::Plane(int width, int height)
    : width_(width),
      height_(height),
      values_(static_cast<size_t>(stride()) * static_cast<size_t>(height + 2 * margin) + float_lanes)
{
}

void Plane::mirror_edges()
{
    for (int y = 0; y < height_; ++y) {
        float* const v = row(y);
        for (int x = -margin; x < 0; ++x) v[x] = v[mirrored(x, width_)];
        for (int x = width_; x < width_ + right_margin; ++x) v[x] = v[mirrored(x, width_)];
    }
    const auto copy_row = [&](int to) {
        const float* const from = row(mirrored(to, height_)) - margin;
        std::copy(from, from + stride(), row(to) - margin);
    };
    for (int y = 1; y <= margin; ++y) copy_row(-y), copy_row(height_ - 1 + y);
}

void for_rows(int height, const std::function<void(int y)>& f)
{
    constexpr int rows = 16;
    parallel_for(static_cast<size_t>((height + rows - 1) / rows), [&](size_t i) {
        const int y0 = static_cast<int>(i) * rows;
        for (int y = y0; y < std::min(height, y0 + rows); ++y) f(y);
    });
}

Plane box_mean(const Plane& in, int radius)
{
    Plane sums(in.width(), in.height()), out(in.width(), in.height());
    for_rows(in.height(), [&](int y) {
        const float* const from = in.row(y);
        float* const to = sums.row(y);
        for (int x = 0; x < in.width(); x += int{float_lanes}) {
            Float8 sum{};
            for (int dx = -radius; dx <= radius; ++dx) sum += load8_anywhere(from + x + dx);
            store8_anywhere(to + x, sum);
        }
    });
    sums.mirror_edges();
    const int side = 2 * radius + 1;
    const float scale = 1.0f / static_cast<float>(side * side);
    for_rows(in.height(), [&](int y) {
        float* const to = out.row(y);
        for (int x = 0; x < in.width(); x += int{float_lanes}) {
            Float8 sum{};
            for (int dy = -radius; dy <= radius; ++dy) sum += load8_anywhere(sums.row(y + dy) + x);
            store8_anywhere(to + x, sum * scale);
        }
    });
    out.mirror_edges();
    return out;
}

}  // namespace lancer::denoise
