#include "render/common_numbers.h"

namespace lancer {
namespace {

constexpr uint32_t common_branch = 1;  // of Sampler::key_of(); the pixels' own have 0

Color sum_of(const RadianceSum& a, const RadianceSum& b, const RadianceSum& c)
{
    return RadianceSum{a.r + b.r + c.r, a.g + b.g + c.g, a.b + b.b + c.b}.color();
}

// The difference, as light that comes to where the path splits; 0 where none of it goes on.
Color incident_difference(const Found& f)
{
    const auto part = [](float x, float scale) { return scale > 0 ? x / scale : 0.0f; };
    const Color &d = f.difference, &scale = f.at.scale;
    return {part(d.r, scale.r), part(d.g, scale.g), part(d.b, scale.b)};
}

}  // namespace

void begin_batch(const PathPlan& plan, const KernelSettings& settings, uint32_t width, Workspace& w)
{
    const size_t n = w.slots.size();
    if (!plan.has_common_numbers) return w.queue.radiance.assign(n, RadianceSum{});
    w.queue.radiance.assign(3 * n, RadianceSum{});
    w.queue.split_at.assign(n, SplitVertex{});
    w.queue.common_keys.resize(n);
    for (size_t i = 0; i < n; ++i) {
        const SampleId& id = w.slots[i];
        const uint64_t square = uint64_t{id.y / PathPlan::square} * width + id.x / PathPlan::square;
        w.queue.common_keys[i] =
            Sampler::key_of(w.seed_of(settings, id.sample / plan.of_path()), square, common_branch);
    }
}

Color light_of(const Workspace& w, size_t i)
{
    const size_t n = w.slots.size();
    const std::vector<RadianceSum>& sums = w.queue.radiance;
    return sums.size() == n ? sums[i].color() : sum_of(sums[i], sums[n + i], sums[2 * n + i]);
}

Found found_of(const Workspace& w, size_t i)
{
    const size_t n = w.slots.size();
    const Color own = w.queue.radiance[n + i].color(), common = w.queue.radiance[2 * n + i].color();
    return {w.slots[i], light_of(w, i), {own.r - common.r, own.g - common.g, own.b - common.b}, w.queue.split_at[i]};
}

// With errors of variance s^2 by either numbers, those by common ones of i and j correlated by r K_ij, the best linear
// prediction of what pixels' light (own + common) errs by, from their differences D = own - common, has
//     Cov D = s^2 M,  M = (2 - r) I + r K,    Cov(error, D) = s^2 (2 I - M):
// so light is found + W D with W = I - 2 M^-1, and errs by I + W times what own numbers err by and I - W times what
// common ones do. Variances and covariances follow from products of differences alone, whose mean is 0: those of common
// errors are D_i D_j, variances half of D_i^2.
SquareLight light_of_square(std::span<const Found> square)
{
    SquareLight s;
    std::array<bool, square_pixels> tells{};  // and hears
    std::array<Color, square_pixels> difference;
    std::array<OfSquare, 3> colors;
    OfSquare brightness;
    for (size_t i = 0; i < square.size(); ++i) {
        const Found& f = square[i];
        s.light[i] = f.light;
        difference[i] = incident_difference(f);
        tells[i] = kinship(f.at, f.at) > 0 && is_finite(f.light) && is_finite(difference[i]);
        if (!tells[i]) continue;
        colors[0][i] = difference[i].r, colors[1][i] = difference[i].g, colors[2][i] = difference[i].b;
        brightness[i] = luminance(f.at.scale);
    }
    const KinInverse inverse(square, tells);
    for (OfSquare& color : colors) color = inverse.times(color);
    const OfSquare of_all = inverse.times(brightness), of_one = inverse.diagonal();
    double all_left = 0, all_squares = 0, squares_of_all = 0;
    for (size_t i = 0; i < square.size(); ++i) {
        if (!tells[i]) continue;
        const Color half{colors[0][i], colors[1][i], colors[2][i]};
        s.light[i] += (difference[i] - half * 2.0f) * square[i].at.scale;
        // In double, as it is squared: the difference, and what W leaves of it.
        const double b = double{brightness[i]}, d = b * double{luminance(difference[i])};
        const double left = 2 * b * double{luminance(half)};
        s.found_variance += d * d;
        s.variance += left * left + 2 * (1 - 2 * double{of_one[i]}) * d * d;
        if (b > 0) squares_of_all += 2 * (1 - 2 * double{of_all[i]} / b) * d * d;
        all_left += left;
        all_squares += b * b;
    }
    const double covariances = squares_of_all + all_left * all_left - s.variance;
    if (all_squares > 0)  // dealt out so that no single pixel is said to have less noise than none
        for (size_t i = 0; i < square.size(); ++i)
            s.together[i] = covariances * (double{brightness[i]} * double{brightness[i]} / all_squares);
    return s;
}

}  // namespace lancer
