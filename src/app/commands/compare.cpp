// lancer compare: how far a picture is from one reference, or from two independent ones; where; and whether that is
// more than noise.
#include <array>
#include <deque>
#include <filesystem>
#include <limits>
#include <string>

#include "app/commands/commands.h"
#include "app/compare_verdict.h"
#include "app/compared_channels.h"
#include "app/compared_picture.h"
#include "app/console.h"
#include "app/options/options.h"
#include "app/paths.h"
#include "core/names.h"
#include "io/atomic_file.h"
#include "io/image/exr.h"
#include "io/image/hdr.h"
#include "io/image/jpeg.h"
#include "io/image/png.h"
#include "io/image/ppm.h"
#include "io/image/read.h"
#include "report/metrics/error_map.h"
#include "report/metrics/flip.h"
#include "report/metrics/metrics.h"

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
    print_value("relmse_p99", m.relmse_p99);
    print_value("smape", m.smape);
    print_colour("mean", m.mean);
    print_colour("reference_mean", m.reference_mean);
    print_colour("mean_ratio", m.mean_ratio);
    print_result(format_text("%-20s %zu of %zu", "differing_pixels", m.differing_pixels, pixels));
    print_result(format_text("%-20s %.9g at %d %d", "max_difference", m.max_difference, m.max_x, m.max_y));
    if (m.non_finite_pixels || m.reference_non_finite)
        print_result(format_text("%-20s %zu, in the reference %zu", "non_finite_pixels", m.non_finite_pixels,
                                 m.reference_non_finite));
}

void print_flip(const Flip& flip)
{
    print_result(format_text("%-20s %.6f %s", "flip", flip.mean, flip.exposures ? "HDR" : "LDR"));
    print_result(format_text("%-20s %.6f", "flip_weighted_median", flip.weighted_median));
    print_result(format_text("%-20s %.6f to %.6f", "flip_range", flip.min, flip.max));
    if (const auto& e = flip.exposures)
        print_result(format_text("%-20s %d, %.4f to %.4f stops", "flip_exposures", e->count, e->start, e->stop));
}

// Says where two pictures are made of the same random numbers.
void print_shared(const ComparedPicture& a, const ComparedPicture& b)
{
    if (const auto seed = shared_seed(a, b))
        print_result("shared_samples       seed " + *seed + " of " + in_quotes(a.path) + " and " + in_quotes(b.path) +
                     ": not independent, their noise is in part the same and errors come out too small");
}

// Before anything is computed.
void check_outputs(const CompareOptions& options)
{
    for (const std::string& path : options.outputs) {
        if (path == standard_output)
            throw Error(ErrorKind::usage, {}, "--output: the figures are printed there; name a file");
        std::error_code absent;
        for (const std::string& input : {options.picture, options.reference, options.reference2})
            if (std::filesystem::equivalent(path, input, absent))
                throw Error(ErrorKind::usage, {},
                            "--output: " + in_quotes(path) + " would overwrite the input " + in_quotes(input));
        const AtomicFile probe(path);
    }
}

void write_map(const CompareOptions& options, const Image& picture, const Image& reference, const Flip& flip)
{
    const bool is_flip = options.map == ErrorMap::flip;
    std::vector<float> errors = flip.error;
    if (!is_flip) {
        const std::vector<double> relative = relative_squared_errors(picture, reference);
        for (size_t i = 0; i < errors.size(); ++i) errors[i] = static_cast<float>(relative[i]);
    }
    Image numbers = make_image(picture.display, picture.data);
    for (size_t i = 0; i < errors.size(); ++i) numbers.pixels[i] = {errors[i], errors[i], errors[i]};
    const Image colours = is_flip ? draw_errors(picture, errors) : draw_error_powers(picture, errors);
    const Metadata metadata{
        {"map", is_flip ? "flip" : "relmse"}, {"picture", options.picture}, {"reference", options.reference}};
    std::deque<AtomicFile> files;
    for (const std::string& path : options.outputs) {
        AtomicFile& file = files.emplace_back(path);
        switch (format_of(path, options.format)) {
            case PictureFormat::exr:
                write_exr(file, rows_of(numbers), metadata);
                break;
            case PictureFormat::hdr:
                write_hdr(file, rows_of(numbers), metadata);
                break;
            case PictureFormat::png:
                write_png(file, colours, metadata);
                break;
            case PictureFormat::ppm:
                write_ppm(file, colours, metadata);
                break;
            case PictureFormat::jpg:
                write_jpeg(file, colours, metadata);
                break;
        }
        file.finish();
    }
    for (AtomicFile& file : files) file.commit();
}

// What the metrics are of: linear light, or steps of 8 bits, the curve left as it is.
Image measured(const CompareOptions& options, const ComparedPicture& picture)
{
    if (!options.steps) return picture.image;
    Image image = read_image(picture.path, Encoding::linear);
    for (Color& c : image.pixels) c *= 255.0f;
    return image;
}

// The error that the limit is for, and its name.
struct Judged {
    const char* name;
    double error;
};

// x, r: what is measured of the picture and of the reference.
Judged print_errors(const CompareOptions& options, const ComparedPicture& picture, const Image& x,
                    const ComparedPicture& reference, const Image& r, const Metrics& metrics, const Flip& flip)
{
    print_metrics(metrics, x.pixels.size());
    if (options.steps) print_result(format_text("%-20s %zu", "beyond_one_step", pixels_beyond(1.5, x, r)));
    print_flip(flip);
    const std::array<Judged, 4> errors{
        {{"rmse", metrics.rmse}, {"relmse", metrics.relmse}, {"smape", metrics.smape}, {"flip", flip.mean}}};
    Judged judged = errors[static_cast<size_t>(options.metric)];
    if (metrics.non_finite_pixels || metrics.reference_non_finite)
        judged.error = std::numeric_limits<double>::infinity();  // beyond every limit
    print_shared(picture, reference);
    if (options.reference2.empty()) return judged;
    const ComparedPicture second = read_compared(options.reference2);
    const Image r2 = measured(options, second);
    const double unbiased = unbiased_squared_error(x, r, r2);
    print_value("relmse_unbiased", unbiased);
    // Half of the difference's square is the variance of either.
    print_value("reference_noise", compare(r, r2).relmse / 2);
    print_shared(picture, second);
    print_shared(reference, second);
    if (options.metric == Metric::relmse) judged = {"relmse_unbiased", unbiased};
    return judged;
}

}  // namespace

int run_compare(int argc, char** argv)
{
    const auto options = parse_compare(argc, argv);
    if (!options) return exit_done;
    const ComparedPicture picture = read_compared(options->picture), reference = read_compared(options->reference);
    require_same_windows(picture.image, reference.image);
    check_outputs(*options);

    const Image x = measured(*options, picture), r = measured(*options, reference);
    const Metrics metrics = compare(x, r);
    const bool is_hdr = picture.is_float && reference.is_float;
    const Flip flip = is_hdr ? flip_hdr(picture.image, reference.image) : flip_ldr(picture.image, reference.image);
    const Judged judged = print_errors(*options, picture, x, reference, r, metrics, flip);
    print_differing_channels(options->picture, options->reference);
    const auto noise = test_noise(picture, reference);
    if (noise && metrics.differing_pixels) print_noise(*noise, picture, reference);
    if (!options->outputs.empty()) write_map(*options, picture.image, reference.image, flip);
    print_result("verdict: " + verdict(picture, reference, metrics, noise));

    // So that an error that is not a number is beyond every limit.
    if (!options->fail_above || judged.error <= *options->fail_above) return exit_done;
    print_problem(format_text("error: %s %.9g is above %.9g", judged.name, judged.error, *options->fail_above));
    return exit_failed;
}

}  // namespace lancer
