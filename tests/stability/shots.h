// Pictures within a row: taken in one call, what they counted being added to the row's outcome; and what they say.
#pragma once

#include "core/parallel.h"
#include "report/page/number_text.h"
#include "stability/counted_render.h"
#include "support/shoot.h"

namespace lancer::stability {

Film shoot(const SceneDescription& d, const Shot& shot, const Setup& setup, Outcome& out);

// The largest difference of any channel of any pixel from what it should be, as a part of that.
double worst_pixel(const Film& film, Color expected);

// The sum of all pixels: exactly 0 where no light may be.
double all_light(const Film& film);

// Each tile of 8 x 8 pixels, as the mean of its pixels and the error of that; samples must be independent.
struct Tile8 {
    double mean = 0, variance = 0;  // of the mean
};
std::vector<Tile8> tiles_of(const Film& film);

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
