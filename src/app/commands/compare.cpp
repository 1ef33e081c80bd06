// lancer compare: how far a picture is from one reference, or from two independent ones; where; and whether that is
// more than noise.
#include <array>
#include <deque>
#include <filesystem>
#include <limits>
#include <string>

#include "app/commands/commands.h"
#include "app/compare_json.h"
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
#include "report/metrics/noise_test.h"

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
void note_shared(const ComparedPicture& a, const ComparedPicture& b, std::vector<std::string>& shared)
{
    if (const auto seed = shared_seed(a, b))
        shared.push_back("seed " + *seed + " of " + in_quotes(a.path) + " and " + in_quotes(b.path) +
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

// What is measured of a picture, x, and a reference, r.
ComparedErrors errors_of(const CompareOptions& options, const ComparedPicture& picture,
                         const ComparedPicture& reference)
{
    const Image x = measured(options, picture), r = measured(options, reference);
    ComparedErrors e{.pixels = x.pixels.size(), .metrics = compare(x, r)};
    const bool is_hdr = picture.is_float && reference.is_float;
    e.flip = is_hdr ? flip_hdr(picture.image, reference.image) : flip_ldr(picture.image, reference.image);
    if (options.steps) e.beyond_one_step = pixels_beyond(1.5, x, r);
    const Metrics& metrics = e.metrics;
    const std::array<double, 4> errors{metrics.rmse, metrics.relmse, metrics.smape, e.flip.mean};
    e.judged_by = name_of(options.metric);
    e.judged = errors[static_cast<size_t>(options.metric)];
    if (metrics.non_finite_pixels || metrics.reference_non_finite)
        e.judged = std::numeric_limits<double>::infinity();  // beyond every limit
    note_shared(picture, reference, e.shared);
    if (options.reference2.empty()) return e;
    const ComparedPicture second = read_compared(options.reference2);
    const Image r2 = measured(options, second);
    e.unbiased = unbiased_squared_error(x, r, r2);
    // Half of the difference's square is the variance of either.
    e.reference_noise = compare(r, r2).relmse / 2;
    note_shared(picture, second, e.shared_with_second);
    note_shared(reference, second, e.shared_with_second);
    if (options.metric == Metric::relmse) e.judged_by = "relmse_unbiased", e.judged = *e.unbiased;
    return e;
}

void print_errors(const ComparedErrors& e)
{
    const auto print_shared = [](const std::vector<std::string>& lines) {
        for (const std::string& line : lines) print_result("shared_samples       " + line);
    };
    print_metrics(e.metrics, e.pixels);
    if (e.beyond_one_step) print_result(format_text("%-20s %zu", "beyond_one_step", *e.beyond_one_step));
    print_flip(e.flip);
    print_shared(e.shared);
    if (!e.unbiased) return;
    print_value("relmse_unbiased", *e.unbiased);
    print_value("reference_noise", *e.reference_noise);
    print_shared(e.shared_with_second);
}

}  // namespace

int run_compare(int argc, char** argv)
{
    const auto options = parse_compare(argc, argv);
    if (!options) return exit_done;
    const ComparedPicture picture = read_compared(options->picture), reference = read_compared(options->reference);
    require_same_windows(picture.image, reference.image);
    check_outputs(*options);

    const ComparedErrors errors = errors_of(*options, picture, reference);
    const DifferingChannels channels = differing_channels(options->picture, options->reference);
    const auto noise = test_noise(picture, reference);
    if (!options->json) {
        print_errors(errors);
        print_differing_channels(channels);
        if (noise && errors.metrics.differing_pixels) print_noise(*noise, picture, reference);
    }
    if (!options->outputs.empty()) write_map(*options, picture.image, reference.image, errors.flip);
    const std::string judgement = verdict(picture, reference, errors.metrics, noise);
    print_result(options->json ? compare_json(*options, errors, channels, noise, judgement) : "verdict: " + judgement);

    // So that an error that is not a number is beyond every limit.
    if (!options->fail_above || errors.judged <= *options->fail_above) return exit_done;
    print_problem(format_text("error: %s %.9g is above %.9g", std::string(errors.judged_by).c_str(), errors.judged,
                              *options->fail_above));
    return exit_failed;
}

}  // namespace lancer
