#include "report/study/level.h"

#include <algorithm>
#include <cmath>

#include "report/metrics/metrics.h"
#include "report/page/number_text.h"
#include "report/study/ranking.h"

namespace lancer {
namespace {

constexpr Interval untold{no_number, no_number};

std::array<double, 3> sums_of(const Image& image)
{
    std::array<double, 3> sums{};
    for (const Color& pixel : image.pixels) {
        const auto values = channels(pixel);
        for (size_t c = 0; c < 3; ++c) sums[c] += values[c];
    }
    return sums;
}

double product(const Image& x, const Image& y, const Image& r1, const Image& r2)
{
    double total = 0;
    for (size_t i = 0; i < x.pixels.size(); ++i) {
        const auto a = channels(x.pixels[i]), b = channels(y.pixels[i]);
        const auto p = channels(r1.pixels[i]), q = channels(r2.pixels[i]);
        for (size_t c = 0; c < 3; ++c) total += (a[c] - p[c]) * (b[c] - q[c]) / (p[c] * q[c] + relmse_epsilon);
    }
    const double mean = total / (3 * static_cast<double>(x.pixels.size()));
    return std::isnan(mean) ? std::numeric_limits<double>::infinity() : mean;
}

}  // namespace

PictureLevel level_of(const std::vector<Image>& pictures, const Image& first, const Image& second)
{
    const size_t n = pictures.size();
    for (const Image& picture : pictures) require_same_windows(picture, first);
    require_same_windows(first, second);
    PictureLevel level;
    level.pictures = n;
    std::vector<std::array<double, 3>> sums;
    for (const Image& picture : pictures) sums.push_back(sums_of(picture));
    const auto reference = sums_of(first), other = sums_of(second);
    for (size_t c = 0; c < 3; ++c) {
        const double of_reference = (reference[c] + other[c]) / 2;
        const auto ratio = [&](std::span<const size_t> drawn) {
            double total = 0;
            for (const size_t i : drawn) total += sums[i][c];
            const double found = total / static_cast<double>(drawn.size()) / of_reference;
            return std::isnan(found) ? std::numeric_limits<double>::infinity() : found;
        };
        std::vector<size_t> all(n);
        for (size_t i = 0; i < n; ++i) all[i] = i;
        level.ratio[c] = ratio(all);
        level.ratio_interval[c] = n < fewest_seeds ? untold : resampled_interval(n, 0, ratio);
    }
    level.systematic_relmse = no_number;
    level.systematic_interval = untold;
    if (n < 2) return level;
    std::vector<double> products(n * n);
    double total = 0;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < i; ++j) {
            products[i * n + j] = products[j * n + i] =
                (product(pictures[i], pictures[j], first, second) + product(pictures[j], pictures[i], first, second)) /
                2;
            total += products[i * n + j];
        }
    level.systematic_relmse = total / (static_cast<double>(n * (n - 1)) / 2);
    if (n < fewest_seeds) return level;
    level.systematic_interval = resampled_interval(n, 0, [&](std::span<const size_t> drawn) {
        double sum = 0, count = 0;
        for (size_t a = 0; a < drawn.size(); ++a)
            for (size_t b = 0; b < a; ++b)
                // A picture with itself would bring its noise in.
                if (drawn[a] != drawn[b]) sum += products[drawn[a] * n + drawn[b]], ++count;
        return count > 0 ? sum / count : level.systematic_relmse;
    });
    return level;
}

std::string why_other_level(const PictureLevel& level)
{
    for (size_t c = 0; c < 3; ++c) {
        const bool told = !std::isnan(level.ratio_interval[c].low);
        const Interval i = told ? level.ratio_interval[c] : Interval{level.ratio[c], level.ratio[c]};
        if (i.low > 1 + largest_level_difference || i.high < 1 - largest_level_difference)
            return "not comparable: its mean radiance is " + significant(level.ratio[c], 4) + " times the reference's";
    }
    return "";
}

}  // namespace lancer
