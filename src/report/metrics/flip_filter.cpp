#include "report/metrics/flip_filter.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/vec.h"

namespace lancer::flip {
namespace {

// Weights of 2 r + 1 neighbours, the middle one's in the middle.
using Kernel = std::vector<double>;

template <class F>
Kernel make_kernel(int radius, const F& weight)
{
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(static_cast<double>(i)));
    return kernel;
}

// Positive weights come to 1 then, negative ones, if there are any, to -1.
void normalise(Kernel& kernel)
{
    double positive = 0, negative = 0;
    for (const double w : kernel) (w > 0 ? positive : negative) += std::abs(w);
    for (double& w : kernel) w /= w > 0 ? positive : (negative > 0 ? negative : 1);
}

size_t clamped(size_t i, size_t k, size_t radius, size_t size)
{
    return i + k < radius ? 0 : std::min(i + k - radius, size - 1);
}

Plane along_rows(const Plane& in, const Kernel& kernel)
{
    Plane out(in.width, in.height);
    const size_t radius = kernel.size() / 2;
    parallel_for(in.height, [&](size_t y) {
        std::vector<float> row(in.width + 2 * radius);
        for (size_t x = 0; x < row.size(); ++x) row[x] = in.values[y * in.width + clamped(x, 0, radius, in.width)];
        std::vector<double> sums(in.width);
        for (size_t k = 0; k < kernel.size(); ++k)
            for (size_t x = 0; x < in.width; ++x) sums[x] += kernel[k] * static_cast<double>(row[x + k]);
        for (size_t x = 0; x < in.width; ++x) out.values[y * in.width + x] = static_cast<float>(sums[x]);
    });
    return out;
}

Plane along_columns(const Plane& in, const Kernel& kernel)
{
    Plane out(in.width, in.height);
    const size_t radius = kernel.size() / 2;
    parallel_for(in.height, [&](size_t y) {
        std::vector<double> sums(in.width);
        for (size_t k = 0; k < kernel.size(); ++k) {
            const float* const row = &in.values[clamped(y, k, radius, in.height) * in.width];
            for (size_t x = 0; x < in.width; ++x) sums[x] += kernel[k] * static_cast<double>(row[x]);
        }
        for (size_t x = 0; x < in.width; ++x) out.values[y * in.width + x] = static_cast<float>(sums[x]);
    });
    return out;
}

Plane length_of(const Plane& a, const Plane& b)
{
    Plane out(a.width, a.height);
    for (size_t i = 0; i < out.values.size(); ++i) out.values[i] = std::hypot(a.values[i], b.values[i]);
    return out;
}

// Contrast sensitivity as a sum of two Gaussians of frequency, a exp(-b f^2), f in cycles per degree; table 1 of the
// paper. As a function of place each is a sqrt(pi_d / b) exp(-(pi_d x)^2 / b), x in degrees.
struct Sensitivity {
    std::array<double, 2> a, b;
};
constexpr std::array<Sensitivity, 3> sensitivities{{
    {{1, 0}, {0.0047, 1e-5}},
    {{1, 0}, {0.0053, 1e-5}},
    {{34.1, 13.5}, {0.04, 0.025}},
}};
constexpr double widest = 0.04;  // the largest b: all kernels reach three of its standard deviations

Plane blur(const Plane& in, const Sensitivity& s)
{
    const auto radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi_d * pi_d)) * pixels_per_degree));
    std::array<Kernel, 2> kernels;
    std::array<double, 2> parts{};
    for (size_t i = 0; i < 2; ++i) {
        kernels[i] = make_kernel(radius, [&](double x) {
            const double degrees = x / pixels_per_degree;
            return std::exp(-pi_d * pi_d * degrees * degrees / s.b[i]);
        });
        double sum = 0;
        for (const double w : kernels[i]) sum += w;
        parts[i] = s.a[i] * std::sqrt(pi_d / s.b[i]) * sum * sum;
        normalise(kernels[i]);
    }
    const double whole = parts[0] + parts[1];
    Plane out = along_columns(along_rows(in, kernels[0]), kernels[0]);
    if (parts[1] == 0) return out;
    const Plane second = along_columns(along_rows(in, kernels[1]), kernels[1]);
    for (size_t i = 0; i < out.values.size(); ++i)
        out.values[i] = static_cast<float>(
            (parts[0] * static_cast<double>(out.values[i]) + parts[1] * static_cast<double>(second.values[i])) / whole);
    return out;
}

}  // namespace

std::array<Plane, 3> blur_as_the_eye(const std::array<Plane, 3>& opponent)
{
    return {blur(opponent[0], sensitivities[0]), blur(opponent[1], sensitivities[1]),
            blur(opponent[2], sensitivities[2])};
}

Features find_features(const Plane& grey)
{
    constexpr double feature_width = 0.082;  // degrees, of what the eye takes for an edge
    const double sigma = 0.5 * feature_width * pixels_per_degree;
    const auto radius = static_cast<int>(std::ceil(3 * sigma));
    const auto bell = [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    Kernel smooth = make_kernel(radius, bell);
    Kernel first = make_kernel(radius, [&](double x) { return -x * bell(x); });
    Kernel second = make_kernel(radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * bell(x); });
    for (Kernel* kernel : {&smooth, &first, &second}) normalise(*kernel);
    const Plane smooth_rows = along_rows(grey, smooth);
    return {length_of(along_columns(along_rows(grey, first), smooth), along_columns(smooth_rows, first)),
            length_of(along_columns(along_rows(grey, second), smooth), along_columns(smooth_rows, second))};
}

}  // namespace lancer::flip
