#include "report/metrics/flip.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "report/metrics/flip_color.h"
#include "report/metrics/flip_filter.h"
#include "report/metrics/metrics.h"
#include "report/metrics/statistics.h"

namespace lancer {
namespace {

using flip::Plane;
using flip::Triple;

// Krzysztof Narkowicz' fit to the ACES film curve (2016) behind a factor of 0.6: (a x^2 + b x) / (c x^2 + d x + e).
constexpr double a = 0.36 * 2.51, b = 0.6 * 0.03, c = 0.36 * 2.43, d = 0.6 * 0.59, e = 0.14;

double aces(double x) { return (a * x * x + b * x) / (c * x * x + d * x + e); }

// Where the curve reaches y < 1.
double aces_inverse(double y)
{
    const double p = a - y * c, q = b - y * d, r = -y * e;
    return (-q + std::sqrt(q * q - 4 * p * r)) / (2 * p);
}

// What of a picture is compared: colours as they look from a distance, and features.
struct View {
    std::array<Plane, 3> lab;
    flip::Features features;
};

// display: a colour of linear light as a screen shows it, in [0, 1].
template <class Display>
View look_at(const Image& image, const Display& display)
{
    const auto width = static_cast<size_t>(image.data.width()), height = static_cast<size_t>(image.data.height());
    const Plane black(width, height);
    std::array<Plane, 3> opponent{black, black, black};
    Plane grey = black;
    const auto rows = [&](const auto& pixel) {
        parallel_for(height, [&](size_t y) {
            for (size_t i = y * width; i < (y + 1) * width; ++i) pixel(i);
        });
    };
    rows([&](size_t i) {
        const Color pixel = is_finite(image.pixels[i]) ? image.pixels[i] : Color{};
        const Triple o = flip::opponent_from_rgb({display(pixel.r), display(pixel.g), display(pixel.b)});
        for (size_t k = 0; k < 3; ++k) opponent[k].values[i] = static_cast<float>(o[k]);
        grey.values[i] = static_cast<float>((o[0] + 16) / 116);
    });
    View view{flip::blur_as_the_eye(opponent), flip::find_features(grey)};
    rows([&](size_t i) {
        Triple o{};
        for (size_t k = 0; k < 3; ++k) o[k] = static_cast<double>(view.lab[k].values[i]);
        Triple rgb = flip::rgb_from_opponent(o);
        for (double& x : rgb) x = std::clamp(x, 0.0, 1.0);
        const Triple lab = flip::lab_from_rgb(rgb);
        for (size_t k = 0; k < 3; ++k) view.lab[k].values[i] = static_cast<float>(lab[k]);
    });
    return view;
}

double error_at(const View& x, const View& r, size_t i)
{
    Triple p{}, q{};
    for (size_t k = 0; k < 3; ++k)
        p[k] = static_cast<double>(x.lab[k].values[i]), q[k] = static_cast<double>(r.lab[k].values[i]);
    const auto apart = [i](const Plane& s, const Plane& t) {
        return std::abs(static_cast<double>(s.values[i]) - static_cast<double>(t.values[i]));
    };
    const double feature =
        std::max(apart(x.features.edges, r.features.edges), apart(x.features.points, r.features.points));
    return std::pow(flip::color_error(flip::hyab(p, q)), 1 - std::sqrt(feature * std::sqrt(0.5)));
}

// Takes the error of each pixel where it is larger than what was there.
template <class Display>
void add_errors(const Image& test, const Image& reference, const Display& display, std::vector<float>& errors)
{
    const View x = look_at(test, display), r = look_at(reference, display);
    const auto width = static_cast<size_t>(test.data.width());
    parallel_for(errors.size() / width, [&](size_t y) {
        for (size_t i = y * width; i < (y + 1) * width; ++i) {
            const bool finite = is_finite(test.pixels[i]) && is_finite(reference.pixels[i]);
            errors[i] = std::max(errors[i], finite ? static_cast<float>(error_at(x, r, i)) : 1.0f);
        }
    });
}

double sum(const std::vector<float>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0, [](double s, float v) { return s + double{v}; });
}

double weighted_median(std::vector<float> values)
{
    std::sort(values.begin(), values.end());
    const double half = sum(values) / 2;
    double so_far = 0;
    for (const float v : values) {
        so_far += double{v};
        if (so_far > half) return double{v};
    }
    return double{values.back()};
}

Flip pooled(std::vector<float> errors)
{
    Flip result;
    const auto [least, most] = std::minmax_element(errors.begin(), errors.end());
    result.min = double{*least}, result.max = double{*most};
    result.mean = sum(errors) / static_cast<double>(errors.size());
    result.weighted_median = weighted_median(errors);
    result.error = std::move(errors);
    return result;
}

}  // namespace

Flip flip_ldr(const Image& test, const Image& reference)
{
    require_same_windows(test, reference);
    std::vector<float> errors(test.pixels.size());
    add_errors(
        test, reference, [](float v) { return std::clamp(double{v}, 0.0, 1.0); }, errors);
    return pooled(std::move(errors));
}

FlipExposures flip_exposures(std::span<const Color> reference)
{
    constexpr double nearly_white = 0.85;
    std::vector<double> values;
    for (const Color pixel : reference)
        if (is_finite(pixel)) values.push_back(luminance(double{pixel.r}, double{pixel.g}, double{pixel.b}));
    const auto black = [](double y) { return !(y > 0); };
    if (std::all_of(values.begin(), values.end(), black)) return {0, 0, 2};
    const double brightest = *std::max_element(values.begin(), values.end());
    double middle = median(values);
    if (black(middle)) {
        values.erase(std::remove_if(values.begin(), values.end(), black), values.end());
        middle = median(std::move(values));
    }
    const double white = aces_inverse(nearly_white);
    const double start = std::log2(white / brightest), stop = std::log2(white / middle);
    return {start, stop, std::max(2, static_cast<int>(std::ceil(stop - start)))};
}

Flip flip_hdr(const Image& test, const Image& reference)
{
    require_same_windows(test, reference);
    const FlipExposures exposures = flip_exposures(reference.pixels);
    std::vector<float> errors(test.pixels.size());
    for (int i = 0; i < exposures.count; ++i) {
        const double stops = std::lerp(exposures.start, exposures.stop, i / (exposures.count - 1.0));
        const double factor = std::exp2(stops);
        const auto display = [&](float v) { return v > 0 ? std::min(aces(factor * double{v}), 1.0) : 0; };
        add_errors(test, reference, display, errors);
    }
    Flip result = pooled(std::move(errors));
    result.exposures = exposures;
    return result;
}

}  // namespace lancer
