// lancer compare: how far a picture is from one reference, or from two independent ones.
#include <array>
#include <string>

#include "app/commands.h"
#include "app/console.h"
#include "app/options.h"
#include "io/image_read.h"
#include "report/metrics.h"

namespace lancer {
namespace {

void print_value(const char* name, double value) { print_result(format_text("%-20s %.9g", name, value)); }
void print_colour(const char* name, const std::array<double, 3>& c)
{
    print_result(format_text("%-20s %.9g %.9g %.9g", name, c[0], c[1], c[2]));
}

void print_metrics(const Metrics& m, size_t pixels)
{
    print_value("rmse", m.rmse);
    print_value("relmse", m.relmse);
    print_value("relmse_trimmed", m.relmse_trimmed);
    print_colour("mean", m.mean);
    print_colour("reference_mean", m.reference_mean);
    print_colour("mean_ratio", m.mean_ratio);
    print_result(format_text("%-20s %zu of %zu", "differing_pixels", m.differing_pixels, pixels));
    print_result(format_text("%-20s %.9g at %d %d", "max_difference", m.max_difference, m.max_x, m.max_y));
    if (m.non_finite_pixels || m.reference_non_finite)
        print_result(format_text("%-20s %zu, in the reference %zu", "non_finite_pixels", m.non_finite_pixels,
                                 m.reference_non_finite));
}

// In steps of 8 bits, the curve left as it is; else in linear light.
Image read_for(const CompareOptions& options, const std::string& path)
{
    Image image = read_image(path, options.steps ? Encoding::linear : Encoding::srgb);
    if (options.steps)
        for (Color& c : image.pixels) c *= 255.0f;
    return image;
}

}  // namespace

int run_compare(int argc, char** argv)
{
    const auto options = parse_compare(argc, argv);
    if (!options) return exit_done;
    const Image picture = read_for(*options, options->picture), reference = read_for(*options, options->reference);
    const Metrics metrics = compare(picture, reference);
    print_metrics(metrics, picture.pixels.size());
    if (options->steps)
        print_result(format_text("%-20s %zu", "beyond_one_step", pixels_beyond(1.5, picture, reference)));
    double error = options->metric == Metric::rmse ? metrics.rmse : metrics.relmse;
    const char* name = options->metric == Metric::rmse ? "rmse" : "relmse";
    if (!options->reference2.empty()) {
        const double unbiased = unbiased_squared_error(picture, reference, read_for(*options, options->reference2));
        print_value("relmse_unbiased", unbiased);
        if (options->metric == Metric::relmse) error = unbiased, name = "relmse_unbiased";
    }
    // So that an error that is not a number is beyond every limit.
    if (!options->fail_above || error <= *options->fail_above) return exit_done;
    print_problem(format_text("error: %s %.9g is above %.9g", name, error, *options->fail_above));
    return exit_failed;
}

}  // namespace lancer
