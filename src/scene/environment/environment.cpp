#include "scene/environment/environment.h"

#include <atomic>

#include "core/distribution.h"
#include "core/parallel.h"
#include "core/srgb.h"

namespace lancer {
namespace {

// In [0, 1], of density proportional to a straight line from a to b; both >= 0.
double sample_linear(double a, double b, double u)
{
    const double divisor = a + std::sqrt(mix(a * a, b * b, u));
    return divisor > 0 ? std::min(1.0, u * (a + b) / divisor) : 0;
}

}  // namespace

EnvironmentMap::EnvironmentMap(std::shared_ptr<const Raster> picture, Color factor, Color constant, Vec3d rotate_deg,
                               double compensation)
    : width_(picture->width), height_(picture->height), to_world_(make_transform({}, rotate_deg, {1, 1, 1}))
{
    take_texels(*picture, factor, constant);
    picture.reset();
    make_tables(compensation);
}

uint64_t EnvironmentMap::bytes_of(uint32_t width, uint32_t height)
{
    const uint64_t texels = uint64_t{width} * height, cells = texels + width;
    return texels * 3 * sizeof(float) + (cells + height + 1) * sizeof(double);
}

void EnvironmentMap::take_texels(const Raster& picture, Color factor, Color constant)
{
    texels_ = std::make_unique_for_overwrite<float[]>(size_t{width_} * height_ * 3);
    const LinearValues value(picture, Encoding::of_file);
    const size_t green = picture.channels < 3 ? 0 : 1, blue = 2 * green;
    std::atomic<uint64_t> bad{0};
    parallel_for(height_, [&](size_t row) {
        uint64_t bad_here = 0;
        for (size_t i = row * width_; i < (row + 1) * width_; ++i) {
            const size_t first = i * picture.channels;
            const Color c = Color{value[first], value[first + green], value[first + blue]} * factor;
            // std::max keeps its first argument where the other is not a number.
            const Color kept =
                is_finite(c) ? Color{std::max(0.0f, c.r), std::max(0.0f, c.g), std::max(0.0f, c.b)} : Color{};
            bad_here += !(kept == c);
            const Color sum = kept + constant;
            texels_[3 * i] = sum.r, texels_[3 * i + 1] = sum.g, texels_[3 * i + 2] = sum.b;
        }
        bad += bad_here;
    });
    bad_ = bad;
}

Color EnvironmentMap::texel(uint32_t column, uint32_t row) const
{
    const float* t = &texels_[3 * (size_t{row} * width_ + column)];
    return {t[0], t[1], t[2]};
}
double EnvironmentMap::weight(uint32_t column, uint32_t row) const
{
    const Color c = texel(column, row);
    return std::max(0.0, luminance(c.r, c.g, c.b) - threshold_);
}

double EnvironmentMap::border(uint32_t row) const
{
    return std::clamp(row - 0.5, 0.0, static_cast<double>(height_)) * (pi_d / height_);
}
double EnvironmentMap::solid_angle(uint32_t row) const
{
    // The difference of the cosines of the borders, without cancellation.
    const double top = border(row), bottom = border(row + 1);
    return 2 * pi_d / width_ * 2 * std::sin((top + bottom) / 2) * std::sin((bottom - top) / 2);
}

void EnvironmentMap::make_tables(double compensation)
{
    sum_weights();
    is_black_ = total_ == 0;
    if (!(compensation > 0)) return;
    threshold_ = compensation * total_ / (4 * pi_d);
    sum_weights();
}

// The weight of a cell is the mean of its corners times its solid angle.
void EnvironmentMap::sum_weights()
{
    const size_t rows = size_t{height_} + 1;
    if (!in_row_) in_row_ = std::make_unique_for_overwrite<double[]>(rows * width_);
    if (!rows_) rows_ = std::make_unique_for_overwrite<double[]>(rows);
    total_ = 0;
    parallel_for(rows, [&](size_t r) {
        const auto row = static_cast<uint32_t>(r);
        const uint32_t above = row ? row - 1 : 0, below = std::min(row, height_ - 1);
        const double quarter = 0.25 * solid_angle(row);
        const auto pair = [&](uint32_t x) { return weight(x, above) + weight(x, below); };
        const double first = pair(0);
        double sum = 0, left = first;
        for (uint32_t x = 0; x < width_; ++x) {
            const double right = x + 1 < width_ ? pair(x + 1) : first;
            in_row_[r * width_ + x] = sum += quarter * (left + right);
            left = right;
        }
        rows_[r] = sum;
    });
    for (size_t row = 0; row < rows; ++row) rows_[row] = total_ += rows_[row];
}

EnvironmentMap::Place EnvironmentMap::place_of(Vec3 wi) const
{
    const Vec3d d = to_world_.normal_by_inverse(to_double(wi));
    const double longitude = std::atan2(d.x, d.z), polar = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y);
    return {(0.5 - longitude / (2 * pi_d)) * width_, polar / pi_d * height_};
}
Vec3 EnvironmentMap::direction_of(Place p) const
{
    const double longitude = (0.5 - p.x / width_) * 2 * pi_d, polar = p.y / height_ * pi_d, s = std::sin(polar);
    return to_float(to_world_.vector({std::sin(longitude) * s, std::cos(polar), std::cos(longitude) * s}));
}

EnvironmentMap::Cell EnvironmentMap::cell_of(Place p) const
{
    const double x = std::floor(p.x - 0.5), y = std::floor(p.y - 0.5);
    Cell c{};
    c.x = p.x - 0.5 - x, c.y = p.y - 0.5 - y;
    // x is -1 in the left half of the first column, whose neighbour is the last.
    c.left = x < 0 ? width_ - 1 : std::min(static_cast<uint32_t>(x), width_ - 1);
    c.right = c.left + 1 < width_ ? c.left + 1 : 0;
    c.row = std::min(static_cast<uint32_t>(y + 1), height_);
    c.above = c.row ? c.row - 1 : 0;
    c.below = std::min(c.row, height_ - 1);
    return c;
}

Color EnvironmentMap::lookup(Place p) const
{
    const Cell c = cell_of(p);
    const auto x = static_cast<float>(c.x), y = static_cast<float>(c.y);
    return mix(mix(texel(c.left, c.above), texel(c.right, c.above), x),
               mix(texel(c.left, c.below), texel(c.right, c.below), x), y);
}
Color EnvironmentMap::eval(Vec3 wi) const { return lookup(place_of(wi)); }

// As the lookup, but linear in the cosine of the polar angle: so the cells' weights are its integrals.
float EnvironmentMap::pdf(Place p) const
{
    if (!is_sampled()) return 0;
    const Cell c = cell_of(p);
    const double above = mix(weight(c.left, c.above), weight(c.right, c.above), c.x);
    const double below = mix(weight(c.left, c.below), weight(c.right, c.below), c.x);
    if (above == 0 && below == 0) return 0;  // below the threshold
    // The part of the cell's solid angle above the place, without cancellation. The half cells at the poles have the
    // same above and below.
    const double step = pi_d / height_, top = border(c.row), down = c.y * step / 2;
    const double part = std::sin(top + down) * std::sin(down) / (std::sin(top + step / 2) * std::sin(step / 2));
    return static_cast<float>(mix(above, below, std::clamp(part, 0.0, 1.0)) / total_);
}
float EnvironmentMap::pdf(Vec3 wi) const { return pdf(place_of(wi)); }
EnvironmentSample EnvironmentMap::at(Vec3 wi) const
{
    const Place p = place_of(wi);
    return {wi, lookup(p), pdf(p)};
}

EnvironmentSample EnvironmentMap::sample(Vec2 u) const
{
    // The index of the step of a cumulative table that holds x, and where in it, in [0, 1].
    const auto draw = [](const double* table, uint32_t count, double x, double& remainder) {
        const auto i = static_cast<uint32_t>(std::upper_bound(table, table + count - 1, x) - table);
        const double before = i ? table[i - 1] : 0;
        remainder = std::min(1.0, (x - before) / (table[i] - before));
        return i;
    };
    double down = 0, across = 0;
    const uint32_t row = draw(rows_.get(), height_ + 1, extend_precision(u.x, u.y) * total_, down);
    const double* in_row = &in_row_[size_t{row} * width_];
    const uint32_t left = draw(in_row, width_, extend_precision(u.y, u.x) * in_row[width_ - 1], across);

    const uint32_t above = row ? row - 1 : 0, below = std::min(row, height_ - 1);
    const uint32_t right = left + 1 < width_ ? left + 1 : 0;
    const double a = weight(left, above), b = weight(right, above);
    const double c = weight(left, below), d = weight(right, below);
    const double y = sample_linear(a + b, c + d, down), x = sample_linear(mix(a, c, y), mix(b, d, y), across);

    const double top = border(row), bottom = border(row + 1);
    const double polar = std::acos(std::clamp(mix(std::cos(top), std::cos(bottom), y), -1.0, 1.0));
    const Vec3 wi = direction_of({left + 0.5 + x, std::clamp(polar, top, bottom) / pi_d * height_});
    // All of the direction as float has it. Both are continuous, so it does not matter how it was rounded.
    return at(wi);
}

}  // namespace lancer
