#include "render/denoise/first_order_fit.h"

#include <algorithm>

#include "core/parallel.h"
#include "core/raw_array.h"

namespace lancer::denoise {
namespace {

constexpr int radius = 9, side = 2 * radius + 1;  // of the window
constexpr int patch_radius = 3;
constexpr int group_width = 2 * lanes;  // pixels: eight fits, two pixels apart
constexpr int part_width = 64, part_height = 32;
constexpr float offset_scale = 0.1f;   // offsets in the picture vary by about 1, as features do
constexpr float least_weight = 1e-3f;  // smaller weights count as 0
constexpr float enough = 1;            // sum of weights of a pixel's predictions that are as good as a fit of its own

// Rows around a part, their even and odd columns apart, so that what fits see at an offset is contiguous.
class SplitRows {
public:
    explicit SplitRows(const Part& part)
        : length_((part.width() + 2 * border) / 2 + lanes),
          values_(static_cast<size_t>((part.height() + 2 * radius) * 2 * length_))
    {
    }
    // What the fits of a group see at an offset. x, y: of the group's first fit within the part; x is even.
    float* at(int x, int y, int dx, int dy)
    {
        const int column = x + dx + border;
        return values_.data() + ((y + dy + radius) * 2 + (column & 1)) * length_ + column / 2;
    }
    void load(const Plane& plane, const Part& part)
    {
        for (int y = -radius; y < part.height() + radius; ++y)
            for (int x = -border; x < part.width() + border; ++x) *at(0, 0, x, y) = plane.row(part.y0 + y)[part.x0 + x];
    }

private:
    static constexpr int border = radius + 1;  // even, as x is

    int length_;
    std::vector<float> values_;
};

// Weighted sums of predictions: three channels and the weight.
using Predictions = std::array<Plane, 4>;

// Which fits of a part are done, a bit each: eight of a group, groups row by row.
class WantedFits {
public:
    // All of them if `weight` is empty, else those of pixels whose predictions have little weight so far.
    WantedFits(const Plane& picture, const Plane* weight, const Part& part)
        : groups_x_(part.width() / group_width), bits_(static_cast<size_t>(groups_x_ * ((part.height() + 1) / 2)))
    {
        for (int y = 0; y < part.height(); y += 2)
            for (int x = 0; x < part.width(); x += 2) {
                const int px = part.x0 + x, py = part.y0 + y;
                if (px >= picture.width() || py >= picture.height()) continue;
                if (weight == nullptr || weight->row(py)[px] < enough)
                    bits_[at(x, y)] |= static_cast<uint8_t>(1u << (x % group_width / 2));
            }
    }
    bool any() const
    {
        return std::any_of(bits_.begin(), bits_.end(), [](uint8_t bits) { return bits != 0; });
    }
    // Of the group whose first fit is at (x, y) in the part.
    uint8_t of_group(int x, int y) const { return bits_[at(x, y)]; }

private:
    size_t at(int x, int y) const { return static_cast<size_t>(y / 2 * groups_x_ + x / group_width); }

    int groups_x_;
    std::vector<uint8_t> bits_;
};

// The fits of a part.
class PartFits {
public:
    // part: of whole groups.
    PartFits(const ColorPlanes& color, const Features& features, const Guide& guide, const Part& part,
             const WantedFits& wanted)
        : part_(part),
          fits_x_(part_.width() / 2),
          fits_y_((part_.height() + 1) / 2),
          observed_(observed_count, SplitRows(part_)),
          predicted_(bandwidths * 4, SplitRows(part_)),
          weights_(static_cast<size_t>(side * side * fits_x_ * fits_y_))
    {
        for (size_t c = 0; c < 3; ++c) observed_[c].load(color[c], part_);
        for (size_t f = 0; f < feature_count; ++f) observed_[3 + f].load(features[f], part_);
        find_weights(guide);
        for (int y = 0; y < part_.height(); y += 2)
            for (int x = 0; x < part_.width(); x += group_width)
                if (const uint8_t bits = wanted.of_group(x, y)) fit(x, y, lanes_of(bits));
    }
    void add_to(std::array<Predictions, bandwidths>& sums)
    {
        for (size_t k = 0; k < bandwidths; ++k)
            for (size_t c = 0; c < 4; ++c) {
                Plane& to = sums[k][c];
                const int x0 = std::max(-radius, -part_.x0),
                          x1 = std::min(part_.width() + radius, to.width() - part_.x0);
                const int y0 = std::max(-radius, -part_.y0);
                const int y1 = std::min(part_.height() + radius, to.height() - part_.y0);
                for (int y = y0; y < y1; ++y)
                    for (int x = x0; x < x1; ++x)
                        to.row(part_.y0 + y)[part_.x0 + x] += *predicted_[k * 4 + c].at(0, 0, x, y);
            }
    }

private:
    static constexpr size_t observed_count = 3 + feature_count;

    // The weights of a group for an offset, with k = 1.
    float* weights(int x, int y, int dx, int dy)
    {
        return weights_.get() + (((dy + radius) * side + dx + radius) * fits_y_ + y / 2) * fits_x_ + x / 2;
    }
    void find_weights(const Guide& guide)
    {
        PatchDistance patches(guide, patch_radius);
        std::vector<float> distances(static_cast<size_t>(part_.width() * part_.height()));
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx) {
                patches.compute(part_, dx, dy, 2, distances.data());
                for (int y = 0; y < part_.height(); y += 2)
                    for (int x = 0; x < part_.width(); x += group_width) {
                        const float* const from = distances.data() + y * part_.width() + x;
                        const Float8 even = even_lanes(load8_anywhere(from), load8_anywhere(from + lanes));
                        store8_anywhere(weights(x, y, dx, dy),
                                        weight_of(permute(even, UInt8{0, 1, 4, 5, 2, 3, 6, 7}), 1));
                    }
            }
    }

    // The weights of a row of the window for each bandwidth. False if all are 0.
    bool load_weights(int x, int y, int dy)
    {
        Float8 any{};
        for (int i = 0; i < side; ++i) {
            const Float8 wide = load8_anywhere(weights(x, y, i - radius, dy));
            const Float8 squared = wide * wide, narrow = squared * squared;  // a quarter of k^2: the fourth power
            row_weights_[static_cast<size_t>(i)] = {select(wide < least_weight, Float8{}, wide),
                                                    select(narrow < least_weight, Float8{}, narrow)};
            any = max(any, row_weights_[static_cast<size_t>(i)][0]);
        }
        return movemask(any > Float8{}) != 0;
    }
    void load_observations(int x, int y, int dy)
    {
        for (int i = 0; i < side; ++i) {
            Observation& z = observations_[static_cast<size_t>(i)];
            const int dx = i - radius;
            for (size_t c = 0; c < 3; ++c) z[c] = load8_anywhere(observed_[c].at(x, y, dx, dy));
            z[3] = broadcast(1.0f);
            z[4] = broadcast(static_cast<float>(dx) * offset_scale);
            z[5] = broadcast(static_cast<float>(dy) * offset_scale);
            for (size_t f = 0; f < feature_count; ++f)
                z[6 + f] =
                    load8_anywhere(observed_[3 + f].at(x, y, dx, dy)) - load8_anywhere(observed_[3 + f].at(x, y, 0, 0));
        }
    }
    void fit(int x, int y, Mask8 wanted)
    {
        NormalEquations equations;
        for (int dy = -radius; dy <= radius; ++dy) {
            if (!load_weights(x, y, dy)) continue;
            load_observations(x, y, dy);
            equations.add(observations_.data(), row_weights_.data(), side);
        }
        std::array<Coefficients, bandwidths> fitted;
        for (size_t k = 0; k < bandwidths; ++k) fitted[k] = equations.solve(k);
        for (int dy = -radius; dy <= radius; ++dy) {
            if (!load_weights(x, y, dy)) continue;
            load_observations(x, y, dy);
            for (int i = 0; i < side; ++i)
                for (size_t k = 0; k < bandwidths; ++k) {
                    const Float8 w = select(wanted, row_weights_[static_cast<size_t>(i)][k], Float8{});
                    predict(k, fitted[k], observations_[static_cast<size_t>(i)], w, x, y, i - radius, dy);
                }
        }
    }
    void predict(size_t k, const Coefficients& b, const Observation& z, Float8 w, int x, int y, int dx, int dy)
    {
        const auto add = [&](size_t c, Float8 v) {
            float* const to = predicted_[k * 4 + c].at(x, y, dx, dy);
            store8_anywhere(to, load8_anywhere(to) + v);
        };
        for (size_t c = 0; c < 3; ++c) {
            Float8 v = b[0][c];
            for (size_t i = 1; i < basis_size; ++i) v = fmadd(b[i][c], z[3 + i], v);
            add(c, w * v);
        }
        add(3, w);
    }

    Part part_;
    int fits_x_, fits_y_;
    std::vector<SplitRows> observed_, predicted_;
    RawArray<float> weights_;  // as large as a cache: not cleared first
    std::array<std::array<Float8, bandwidths>, side> row_weights_{};
    std::array<Observation, side> observations_{};
};

// Calls f(part) in parallel for parts that cover a picture, in four passes, each of every second part of every second
// row of parts: what f does to pixels up to half a part away has a fixed order.
void for_parts_apart(int width, int height, const std::function<void(const Part&)>& f)
{
    const int columns = (width + part_width - 1) / part_width, rows = (height + part_height - 1) / part_height;
    for (const int first_row : {0, 1})
        for (const int first_column : {0, 1}) {
            const int n_x = (columns - first_column + 1) / 2, n_y = (rows - first_row + 1) / 2;
            parallel_for(static_cast<size_t>(n_x * n_y), [&](size_t i) {
                const int x0 = (static_cast<int>(i) % n_x * 2 + first_column) * part_width;
                const int y0 = (static_cast<int>(i) / n_x * 2 + first_row) * part_height;
                f({x0, y0, std::min(x0 + part_width, width), std::min(y0 + part_height, height)});
            });
        }
}

// Windows reach into the parts beside theirs.
static_assert(part_width >= 2 * (radius + group_width) && part_height >= 2 * (radius + 1));
static_assert(row_period == 2 * part_height);

}  // namespace

Fitted fit_first_order(const ColorPlanes& color, const Features& features, const Guide& guide,
                       const std::stop_token& stop)
{
    const int width = color[0].width(), height = color[0].height();
    const Plane none(width, height);
    std::array<Predictions, bandwidths> sums;
    for (Predictions& p : sums) p.fill(none);
    // First every second pixel of every second row, then those between that are unlike their neighbours: what unlike
    // fits predict of them is worth nothing.
    for (const int turn : {0, 1, 2, 3}) {
        const int dx = turn & 1, dy = turn >> 1;
        for_parts_apart(width, height, [&](Part part) {
            if (stop.stop_requested()) return;
            const int groups = (part.width() + group_width - 1) / group_width;
            part = {part.x0 + dx, part.y0 + dy, part.x0 + dx + groups * group_width, part.y1 + dy};
            const bool is_first = dx == 0 && dy == 0;
            const WantedFits wanted(color[0], is_first ? nullptr : &sums[bandwidths - 1][3], part);
            if (wanted.any()) PartFits(color, features, guide, part, wanted).add_to(sums);
        });
    }
    Fitted fitted;
    for (size_t k = 0; k < bandwidths; ++k)
        for (size_t c = 0; c < 3; ++c) {
            Plane& p = fitted[k][c] = std::move(sums[k][c]);
            for_rows(height, [&](int y) {
                for (int x = 0; x < width; ++x) p.row(y)[x] /= sums[k][3].row(y)[x];
            });
        }
    return fitted;
}

}  // namespace lancer::denoise
