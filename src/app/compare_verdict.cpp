#include "app/compare_verdict.h"

#include <cmath>
#include <cstdlib>

#include "app/console.h"
#include "core/names.h"

namespace lancer {
namespace {

// Of the mean of the reference, if it has one.
std::string part_of_mean(double x, double mean)
{
    return mean > 0 ? format_text("%.3g %%", 100 * x / mean) : format_text("%.3g (of a mean of %.3g)", x, mean);
}

// Sobol' points leave less noise than as many independent samples would, which is what the variance tells.
bool is_upper_estimate(const ComparedPicture& a, const ComparedPicture& b)
{
    return a.said("sampler") == "sobol" || b.said("sampler") == "sobol";
}

std::string smallest_bias(const NoiseTest& t, bool upper)
{
    return (upper ? "smallest detectable bias at most " : "smallest detectable bias ") +
           part_of_mean(t.detectable, t.reference_mean);
}

// What is more than noise, if anything is.
std::string findings(const NoiseTest& t)
{
    std::string text;
    const auto add = [&](const std::string& finding) { text += (text.empty() ? "" : "; ") + finding; };
    if (t.means_differ())
        add("the means are " + part_of_mean(t.difference, t.reference_mean) + " apart, 95 % from " +
            part_of_mean(t.interval.low, t.reference_mean) + " to " + part_of_mean(t.interval.high, t.reference_mean));
    if (t.quiet_differing)
        add(format_text("%zu pixels without noise are apart, by up to %.3g", t.quiet_differing, t.quiet_difference));
    return text;
}

std::string tiles_apart(const NoiseTest& t)
{
    return format_text("%zu of %zu tiles of 8 x 8 pixels are apart, most so at %d %d", t.tiles_beyond, t.tiles,
                       t.tile_x, t.tile_y);
}

}  // namespace

std::optional<NoiseTest> test_noise(const ComparedPicture& picture, const ComparedPicture& reference)
{
    if (!picture.variance || !reference.variance) return {};
    const auto noisy = [](const ComparedPicture& p) {
        const auto samples = p.said("spp_done");
        return NoisyPicture{p.image, *p.variance, p.rounding, samples ? std::strtod(samples->c_str(), nullptr) : 0};
    };
    return test_noise(noisy(picture), noisy(reference));
}

void print_noise(const NoiseTest& t, const ComparedPicture& picture, const ComparedPicture& reference)
{
    const bool upper = is_upper_estimate(picture, reference);
    if (upper)
        print_result("variance             an upper estimate (sampler sobol): the tests find less than they might");
    const auto part = [&](size_t n) {
        return t.pixels ? 100 * static_cast<double>(n) / static_cast<double>(t.pixels) : 0;
    };
    print_result(format_text("%-20s %.9g of %zu pixels with noise", "z_chi_square", t.chi_square, t.pixels));
    print_result(format_text("%-20s %zu, %.3g %% (normal noise: 0.27 %%)", "z_beyond_3", t.beyond_3, part(t.beyond_3)));
    print_result(format_text("%-20s %zu", "beyond_10_sigma", t.beyond_10));
    print_result(format_text("%-20s %zu of %zu, largest |z| %.3g at %d %d, limit %.3g", "tiles_beyond", t.tiles_beyond,
                             t.tiles, std::abs(t.largest_tile_z), t.tile_x, t.tile_y, t.tile_limit));
    if (t.tiles) print_result(format_text("%-20s %.3g %%", "detectable_in_tile", 100 * t.tile_detectable));
    print_result(format_text("%-20s %zu of %zu, largest difference %.3g", "without_noise_apart", t.quiet_differing,
                             t.quiet, t.quiet_difference));
    print_result(format_text("%-20s %.9g, 95 %% from %.9g to %.9g", "luminance_difference", t.difference,
                             t.interval.low, t.interval.high));
    print_result(format_text("%-20s ", "detectable_bias") + part_of_mean(t.detectable, t.reference_mean));
}

std::string verdict(const ComparedPicture& picture, const ComparedPicture& reference, const Metrics& metrics,
                    const std::optional<NoiseTest>& test)
{
    const size_t broken = metrics.non_finite_pixels + metrics.reference_non_finite;
    if (metrics.differing_pixels == 0)
        return broken ? format_text("same bits, but %zu pixels are not finite", metrics.non_finite_pixels)
                      : "same bits";
    if (broken) return format_text("differ: %zu pixels are not finite", broken);
    if (!test) {
        const ComparedPicture& lacking = picture.variance ? reference : picture;
        return "error only; whether it is noise cannot be told: " + in_quotes(lacking.path) + " " + lacking.no_variance;
    }
    const std::string found = findings(*test), smallest = smallest_bias(*test, is_upper_estimate(picture, reference));
    if (!found.empty()) return "differ: " + found + (test->tiles_beyond ? "; " + tiles_apart(*test) : std::string());
    if (const auto seed = shared_seed(picture, reference))
        return "cannot be told: the pictures share their samples (seed " + *seed + "); render one with another --seed";
    if (test->tiles_beyond)
        return "no difference of the means found (" + smallest + "), but " + tiles_apart(*test) +
               ": a difference there, or samples too few to have met what is rare";
    return "no difference found (" + smallest + ")";
}

}  // namespace lancer
