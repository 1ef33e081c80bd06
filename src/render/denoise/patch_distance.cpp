#include "render/denoise/patch_distance.h"

#include <algorithm>

#include "core/parallel.h"

namespace lancer::denoise {
namespace {

// A part of the unit of variance that keeps divisions by 0 away: planes are scaled to numbers about 1.
constexpr float rounding = 1e-7f;
constexpr float farthest = 1e4f;  // a larger distance counts as this: beyond it no weight is left

}  // namespace

void for_parts(int picture_width, int picture_height, int width, int height, const std::function<void(const Part&)>& f)
{
    const int columns = (picture_width + width - 1) / width, rows = (picture_height + height - 1) / height;
    parallel_for(static_cast<size_t>(columns) * static_cast<size_t>(rows), [&](size_t i) {
        const int x = static_cast<int>(i) % columns * width, y = static_cast<int>(i) / columns * height;
        f({x, y, std::min(x + width, picture_width), std::min(y + height, picture_height)});
    });
}

template <size_t channels>
void PatchDistance::pixels(const Part& part, int dx, int dy)
{
    const float s = guide_.variance_factor;
    float* to = pixels_.data();
    for (int y = part.y0; y < part.y1; ++y, to += part.width()) {
        const float *a[channels], *b[channels], *va[channels], *vb[channels];
        for (size_t c = 0; c < channels; ++c) {
            a[c] = guide_.values[c].row(y) + part.x0, b[c] = guide_.values[c].row(y + dy) + part.x0 + dx;
            va[c] = guide_.variances[c].row(y) + part.x0, vb[c] = guide_.variances[c].row(y + dy) + part.x0 + dx;
        }
        for (int x = 0; x < part.width(); x += lanes) {
            Float8 sum{};
            for (size_t c = 0; c < channels; ++c) {
                const Float8 difference = load8_anywhere(a[c] + x) - load8_anywhere(b[c] + x);
                const Float8 v = load8_anywhere(va[c] + x), w = load8_anywhere(vb[c] + x);
                sum += (difference * difference - s * (v + min(v, w))) / (s * (v + w) + rounding);
            }
            store8_anywhere(to + x, min(sum * (1.0f / float{channels}), broadcast(farthest)));
        }
    }
}

void PatchDistance::compute(const Part& part, int dx, int dy, int step, float* out)
{
    const int width = part.width(), height = part.height(), r = radius_;
    // Rows are eight pixels longer than patches need, for whole lanes.
    const Part around{part.x0 - r, part.y0 - r, part.x1 - r + lanes, part.y1 + r};
    pixels_.resize(static_cast<size_t>(around.width() * around.height()));
    guide_.values.size() == 3 ? pixels<3>(around, dx, dy) : pixels<1>(around, dx, dy);

    rows_.resize(static_cast<size_t>(width * around.height()));
    for (int y = 0; y < around.height(); ++y) {
        const float* const from = pixels_.data() + y * around.width();
        for (int x = 0; x < width; x += lanes) {
            Float8 sum = load8_anywhere(from + x);
            for (int i = 1; i <= 2 * r; ++i) sum += load8_anywhere(from + x + i);
            store8_anywhere(rows_.data() + y * width + x, sum);
        }
    }
    const int side = 2 * r + 1;
    const float scale = 1.0f / static_cast<float>(side * side);
    for (int y = 0; y < height; y += step)
        for (int x = 0; x < width; x += lanes) {
            Float8 sum = load8_anywhere(rows_.data() + y * width + x);
            for (int i = 1; i <= 2 * r; ++i) sum += load8_anywhere(rows_.data() + (y + i) * width + x);
            store8_anywhere(out + y * width + x, sum * scale);
        }
}

}  // namespace lancer::denoise
