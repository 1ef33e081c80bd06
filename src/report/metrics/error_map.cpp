#include "report/metrics/error_map.h"

#include <algorithm>
#include <cmath>

#include "core/srgb.h"
#include "core/vec.h"

namespace lancer {
namespace {

template <class Scale>
Image draw(const Image& like, std::span<const float> errors, const Scale& scale)
{
    Image image = make_image(like.display, like.data);
    for (size_t i = 0; i < errors.size(); ++i) {
        const std::array<double, 3> code = cubehelix(scale(double{errors[i]}));
        const auto linear = [&](size_t c) { return static_cast<float>(linear_from_srgb(code[c])); };
        image.pixels[i] = {linear(0), linear(1), linear(2)};
    }
    return image;
}

}  // namespace

std::array<double, 3> cubehelix(double t)
{
    constexpr double start = 0.5, rotations = -1.5, hue = 1;
    const double x = t > 0 ? std::min(t, 1.0) : 0;
    const double angle = 2 * pi_d * (start / 3 + 1 + rotations * x), amplitude = hue * x * (1 - x) / 2;
    const double u = amplitude * std::cos(angle), v = amplitude * std::sin(angle);
    std::array<double, 3> code{x - 0.14861 * u + 1.78277 * v, x - 0.29227 * u - 0.90649 * v, x + 1.97294 * u};
    for (double& c : code) c = std::clamp(c, 0.0, 1.0);
    return code;
}

Image draw_errors(const Image& like, std::span<const float> errors)
{
    return draw(like, errors, [](double error) { return error; });
}

Image draw_error_powers(const Image& like, std::span<const float> errors)
{
    constexpr double least = -5, most = 1;
    return draw(like, errors, [](double error) { return (std::log10(error) - least) / (most - least); });
}

}  // namespace lancer
