#include "report/metrics/picture_pairs.h"

#include <bit>

#include "report/metrics/metrics.h"

namespace lancer {
namespace {

bool same_bits(const Pixel& a, const Pixel& b)
{
    const auto same = [](double x, double y) { return std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y); };
    return same(a.sum[0], b.sum[0]) && same(a.sum[1], b.sum[1]) && same(a.sum[2], b.sum[2]) &&
           same(a.sum_sq, b.sum_sq) && a.n == b.n;
}

}  // namespace

size_t differing_pixels(const Film& a, const Film& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) count += !same_bits(a.pixels[i], b.pixels[i]);
    return count;
}

std::vector<Color> pixel_means(const Film& film)
{
    std::vector<Color> means;
    for (const Pixel& p : film.pixels)
        if (p.n > 0) means.push_back(p.mean());
    return means;
}

std::vector<Color> mean_of(std::span<const PicturePair* const> pairs)
{
    std::vector<Color> mean((*pairs[0])[0].size());
    for (size_t i = 0; i < mean.size(); ++i)
        for (const PicturePair* pair : pairs)
            for (const std::vector<Color>& picture : *pair)
                mean[i] += picture[i] / static_cast<float>(2 * pairs.size());
    return mean;
}

double error_of(const PicturePair& pair, std::span<const Color> mean)
{
    double sum = 0;
    for (size_t i = 0; i < mean.size(); ++i) {
        const Color a = pair[0][i], b = pair[1][i];
        const auto part = [](float x, float y, float z) {
            const double d = static_cast<double>(x) - static_cast<double>(y), m = static_cast<double>(z);
            return d * d / 2 / (m * m + relmse_epsilon);
        };
        sum += part(a.r, b.r, mean[i].r) + part(a.g, b.g, mean[i].g) + part(a.b, b.b, mean[i].b);
    }
    return sum / (3 * static_cast<double>(mean.size()));
}

}  // namespace lancer
