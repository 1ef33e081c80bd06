// Pictures within a row: taken in one call, what they counted being added to the row's outcome; and what they say.
#pragma once

#include "core/parallel.h"
#include "report/page/number_text.h"
#include "stability/row.h"
#include "support/shoot.h"

namespace lancer::stability {

inline Film shoot(const SceneDescription& d, const Shot& shot, const Setup& setup, Outcome& out)
{
    RenderRequest r;
    r.width = shot.width, r.height = shot.height, r.spp = {shot.spp},
    r.threads = setup.tier == Tier::A ? 1 : available_threads();
    r.images = shot.images;
    r.settings.integrator = shot.integrator;
    r.settings.accel = shot.accel;
    r.settings.kernel.sampler = shot.sampler;
    r.settings.kernel.seed = salted(shot.seed);
    r.settings.kernel.filter = Filter(FilterKind::box);
    Rendered rendered = render(d, r);
    out.samples += uint64_t{shot.spp} * shot.width * shot.height;
    out.dropped += rendered.counters.dropped;
    return std::move(rendered.film);
}

// The largest difference of any channel of any pixel from what it should be, as a part of that.
inline double worst_pixel(const Film& film, Color expected)
{
    double worst = 0;
    for (const Pixel& p : film.pixels)
        for (size_t c = 0; c < 3; ++c) {
            const double e = c == 0 ? double{expected.r} : c == 1 ? double{expected.g} : double{expected.b};
            worst = std::max(worst, std::abs(p.sum[c] / p.n - e) / e);
        }
    return worst;
}

inline double pixels_that_differ(const Film& a, const Film& b)
{
    double count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        count += a.pixels[i].sum != b.pixels[i].sum || a.pixels[i].n != b.pixels[i].n;
    return count;
}

// The sum of all pixels: exactly 0 where no light may be.
inline double all_light(const Film& film)
{
    double sum = 0;
    for (const Pixel& p : film.pixels) sum += p.sum[0] + p.sum[1] + p.sum[2];
    return sum;
}

// Each tile of 8 x 8 pixels, as the mean of its pixels and the error of that; samples must be independent.
struct Tile8 {
    double mean = 0, variance = 0;  // of the mean
};
inline std::vector<Tile8> tiles_of(const Film& film)
{
    std::vector<Tile8> tiles(size_t{film.width / 8} * (film.height / 8));
    for (uint32_t y = 0; y < film.height; ++y)
        for (uint32_t x = 0; x < film.width; ++x) {
            const stats::Tally t = tally(film.at(x, y));
            Tile8& tile = tiles[size_t{y / 8} * (film.width / 8) + x / 8];
            tile.mean += t.mean / 64, tile.variance += t.variance() / t.n / (64.0 * 64);
        }
    return tiles;
}

// The tests of one claim, as in stats::Family: the least p of all against Sidak's level at 0.01.
class Claim {
public:
    void add(double p) { least_ = p < least_ ? p : std::isnan(p) ? 0 : least_, ++count_; }
    // Are all tiles of two pictures alike? rounding: of sums in another order, relative.
    void add_tiles(const Film& a, const Film& b, double rounding = 1e-5)
    {
        const std::vector<Tile8> x = tiles_of(a), y = tiles_of(b);
        for (size_t i = 0; i < x.size(); ++i) {
            const double d = std::abs(x[i].mean - y[i].mean), floor = rounding * std::max(x[i].mean, y[i].mean);
            const double sigma = std::sqrt(x[i].variance + y[i].variance);
            add(d <= floor ? 1 : sigma == 0 ? 0 : stats::normal_p((d - floor) / sigma));
        }
    }
    Measure measure(const std::string& what) const
    {
        return at_least(what + ", least p of " + std::to_string(count_), least_,
                        sidak(claim_level, std::max<size_t>(1, count_)));
    }

private:
    double least_ = 1;
    size_t count_ = 0;
};

}  // namespace lancer::stability
