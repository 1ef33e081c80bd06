#include "report/metrics/noise_test.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "report/metrics/metrics.h"

namespace lancer {
namespace {

// Quantiles of the normal distribution: 95 % on two sides, 80 % on one.
constexpr double two_sided_95 = 1.959963984540054, one_sided_80 = 0.8416212335729143;
constexpr double tiles_false_alarm = 0.01;  // of all tiles together
constexpr int32_t tile_side = 8;

struct Sums {
    double difference = 0, reference = 0;
    double variance = 0, reference_variance = 0;  // of both pictures
    double rounding = 0;
    size_t count = 0;

    // Of the difference, as each picture has it.
    double total() const { return variance + reference_variance + rounding; }
    // The same with what either predicts of the other, which has `ratio` times its samples in the reference; 0: not
    // known. See noise_test.h.
    double cautious(double ratio) const
    {
        if (!(ratio > 0)) return total();
        const double a = std::max(variance, reference_variance * ratio);
        return a + std::max(reference_variance, variance / ratio) + rounding;
    }
};

// The result of one pixel.
Sums pair_at(const NoisyPicture& a, const NoisyPicture& b, size_t i)
{
    const auto value = [i](const NoisyPicture& p) {
        const Color c = p.image.pixels[i];
        return luminance(double{c.r}, double{c.g}, double{c.b});
    };
    // Evenly spread over plus and minus the rounding.
    const auto rounding = [](double v, double part) { return v * v * part * part / 3; };
    const double x = value(a), r = value(b);
    return {.difference = x - r,
            .reference = r,
            .variance = double{a.variance[i]},
            .reference_variance = double{b.variance[i]},
            .rounding = rounding(x, a.rounding) + rounding(r, b.rounding),
            .count = 1};
}

void add(const Sums& pixel, Sums& s)
{
    s.difference += pixel.difference, s.reference += pixel.reference;
    s.variance += pixel.variance, s.reference_variance += pixel.reference_variance;
    s.rounding += pixel.rounding, s.count += pixel.count;
}

void judge_pixel(const Sums& pixel, double ratio, NoiseTest& t)
{
    const double z2 = pixel.difference * pixel.difference / pixel.cautious(ratio);
    ++t.pixels;
    t.chi_square += z2;
    t.beyond_3 += z2 > 9;
    t.beyond_10 += z2 > 100;
}

// The limit for tiles must also hold for noise that is far from normal, such as bright samples in few pixels. A sum of
// independent symmetric terms, over the root of the sum of their squares, exceeds x with a probability of at most
// exp(-x^2 / 2): Efron, "Student's t-test under symmetry conditions", JASA 64, 1969. Differences of pictures with equal
// sample counts are symmetric if the distributions are equal.
double limit_of(size_t tiles) { return std::sqrt(2 * std::log(2 * static_cast<double>(tiles) / tiles_false_alarm)); }

void judge_tiles(const std::vector<Sums>& tiles, size_t across, double ratio, const Window& window, NoiseTest& t)
{
    t.tiles = static_cast<size_t>(std::count_if(tiles.begin(), tiles.end(), [](const Sums& s) { return s.count > 0; }));
    if (t.tiles == 0) return;
    t.tile_limit = limit_of(t.tiles);
    std::vector<double> detectable;
    for (size_t i = 0; i < tiles.size(); ++i) {
        const Sums& s = tiles[i];
        if (s.count == 0) continue;
        const double deviation = std::sqrt(s.cautious(ratio)), z = s.difference / deviation;
        detectable.push_back((t.tile_limit + one_sided_80) * deviation / std::abs(s.reference));
        t.tiles_beyond += std::abs(z) > t.tile_limit;
        if (std::abs(z) <= std::abs(t.largest_tile_z)) continue;
        t.largest_tile_z = z;
        t.tile_x = window.x0 + static_cast<int32_t>(i % across) * tile_side;
        t.tile_y = window.y0 + static_cast<int32_t>(i / across) * tile_side;
    }
    t.tile_detectable = median(std::move(detectable));
}

void judge_means(const Sums& all, NoiseTest& t)
{
    if (all.count == 0) return;
    const auto n = static_cast<double>(all.count);
    t.reference_mean = all.reference / n, t.difference = all.difference / n;
    t.standard_error = std::sqrt(all.total()) / n;
    t.interval = {t.difference - two_sided_95 * t.standard_error, t.difference + two_sided_95 * t.standard_error};
    t.detectable = (two_sided_95 + one_sided_80) * t.standard_error;
}

}  // namespace

NoiseTest test_noise(const NoisyPicture& picture, const NoisyPicture& reference)
{
    require_same_windows(picture.image, reference.image);
    const Window& window = picture.image.data;
    const auto width = static_cast<size_t>(window.width());
    for (const NoisyPicture* p : {&picture, &reference})
        if (p->variance.size() != p->image.pixels.size())
            throw Error(ErrorKind::invalid_input, "error: a variance for each pixel is needed, and for nothing else");

    NoiseTest t;
    const auto tiles_in = [](int32_t pixels) { return static_cast<size_t>((pixels + tile_side - 1) / tile_side); };
    const size_t across = tiles_in(window.width());
    std::vector<Sums> tiles(across * tiles_in(window.height()));
    const double ratio = picture.samples > 0 ? reference.samples / picture.samples : 0;
    std::vector<double> quiet;
    Sums all;
    for (size_t i = 0; i < picture.image.pixels.size(); ++i) {
        const Sums pixel = pair_at(picture, reference, i);
        if (!std::isfinite(pixel.difference) || !std::isfinite(pixel.total())) {
            ++t.left_out;
            continue;
        }
        add(pixel, all);
        if (pixel.variance + pixel.reference_variance > pixel.rounding) {
            judge_pixel(pixel, ratio, t);
            add(pixel, tiles[i / width / tile_side * across + i % width / tile_side]);
        } else {
            quiet.push_back(std::abs(pixel.difference));
        }
    }
    judge_means(all, t);
    judge_tiles(tiles, across, ratio, window, t);
    t.quiet = quiet.size();
    for (const double d : quiet) {
        t.quiet_differing += d > t.detectable;
        t.quiet_difference = std::max(t.quiet_difference, d);
    }
    return t;
}

}  // namespace lancer
