#include "scene/environment.h"

#include <atomic>

#include "core/distribution.h"
#include "core/parallel.h"
#include "core/srgb.h"

namespace lancer {
namespace {

// a itself where both are the same, and never below 0 for a, b >= 0.
float mix(float a, float b, float t) { return a + (b - a) * t; }
Color mix(Color a, Color b, float t) { return {mix(a.r, b.r, t), mix(a.g, b.g, t), mix(a.b, b.b, t)}; }

// Linear values of a picture, pixel by pixel.
class Reader {
public:
    explicit Reader(const Raster& picture) : picture_(picture), table_(make_linear_table(Encoding::srgb, 256)) {}

    Color color(size_t pixel) const
    {
        const size_t first = pixel * picture_.channels;
        if (picture_.channels < 3) return Color{1, 1, 1} * value(first);
        return {value(first), value(first + 1), value(first + 2)};
    }

private:
    float value(size_t i) const
    {
        if (!picture_.bytes.empty()) return table_[picture_.bytes[i]];
        if (picture_.is_float) return picture_.floats[i];
        return static_cast<float>(linear_from_srgb(static_cast<double>(picture_.floats[i])));
    }

    const Raster& picture_;
    std::vector<float> table_;
};

}  // namespace

EnvironmentMap::EnvironmentMap(std::shared_ptr<const Raster> picture, Color factor, Color constant, Vec3d rotate_deg)
    : width_(picture->width), height_(picture->height), to_world_(make_transform({}, rotate_deg, {1, 1, 1}))
{
    take_texels(*picture, factor, constant);
    picture.reset();
    make_tables();
}

uint64_t EnvironmentMap::bytes() const
{
    const uint64_t count = uint64_t{width_} * height_;
    return count * (3 * sizeof(float) + sizeof(double)) + height_ * sizeof(double);
}

void EnvironmentMap::take_texels(const Raster& picture, Color factor, Color constant)
{
    texels_ = std::make_unique_for_overwrite<float[]>(size_t{width_} * height_ * 3);
    const Reader reader(picture);
    std::atomic<uint64_t> bad{0};
    parallel_for(height_, [&](size_t row) {
        uint64_t bad_here = 0;
        for (size_t i = row * width_; i < (row + 1) * width_; ++i) {
            const Color c = reader.color(i) * factor;
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
double EnvironmentMap::texel_luminance(uint32_t column, uint32_t row) const
{
    const Color c = texel(column, row);
    return luminance(c.r, c.g, c.b);
}

double EnvironmentMap::solid_angle(uint32_t row) const
{
    // 2 pi / width times the difference of the cosines of the borders, without cancellation.
    const double step = pi_d / height_;
    return 2 * pi_d / width_ * 2 * std::sin((row + 0.5) * step) * std::sin(0.5 * step);
}

// The weight of a texel is the integral of what lookup() gives in it. The neighbours' ramps reach half a texel in, so a
// texel that shines anywhere is drawn. Across, a ramp holds 1/8 of what a whole texel would; down, it is weighed by
// the sine of the polar angle.
void EnvironmentMap::make_tables()
{
    in_row_ = std::make_unique_for_overwrite<double[]>(size_t{width_} * height_);
    rows_ = std::make_unique_for_overwrite<double[]>(height_);
    const double step = pi_d / height_, part = 2 * std::sin(step / 4) / step;
    parallel_for(height_, [&](size_t r) {
        const auto row = static_cast<uint32_t>(r);
        const double top = row * step, bottom = (row + 1) * step, column = 2 * pi_d / width_;
        const double above = column * (0.5 * std::cos(top) - part * std::cos(top + step / 4));
        const double below = column * (part * std::cos(bottom - step / 4) - 0.5 * std::cos(bottom));
        const double here = solid_angle(row) - above - below;
        const auto weight_of = [&](uint32_t x) {
            return above * texel_luminance(x, row ? row - 1 : 0) + here * texel_luminance(x, row) +
                   below * texel_luminance(x, std::min(row + 1, height_ - 1));
        };
        const double first = weight_of(0);
        double sum = 0, left = weight_of(width_ - 1), middle = first;
        for (uint32_t x = 0; x < width_; ++x) {
            const double right = x + 1 < width_ ? weight_of(x + 1) : first;
            in_row_[r * width_ + x] = sum += 0.125 * (left + right) + 0.75 * middle;
            left = middle, middle = right;
        }
        rows_[r] = sum;
    });
    for (uint32_t row = 0; row < height_; ++row) rows_[row] = total_ += rows_[row];
}

EnvironmentMap::Place EnvironmentMap::place_of(Vec3 wi) const
{
    const Vec3d d = to_world_.normal_by_inverse(to_double(wi));
    const double longitude = std::atan2(d.x, d.z), polar = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y);
    return {(0.5 - longitude / (2 * pi_d)) * width_, polar / pi_d * height_};
}
EnvironmentMap::Texel EnvironmentMap::texel_of(Place p) const
{
    // Longitudes of +pi and -pi are one; the right edge is the left.
    const auto column = static_cast<uint32_t>(p.x), row = static_cast<uint32_t>(p.y);
    return {column < width_ ? column : 0, std::min(row, height_ - 1)};
}
Vec3 EnvironmentMap::direction_of(Place p) const
{
    const double longitude = (0.5 - p.x / width_) * 2 * pi_d, polar = p.y / height_ * pi_d, s = std::sin(polar);
    return to_float(to_world_.vector({std::sin(longitude) * s, std::cos(polar), std::cos(longitude) * s}));
}
// across, down in [0, 1]: equal parts are equal solid angles.
EnvironmentMap::Place EnvironmentMap::place_in(Texel t, double across, double down) const
{
    const double step = pi_d / height_, top = std::cos(t.row * step), bottom = std::cos((t.row + 1) * step);
    const double y = std::acos(std::clamp(top + (bottom - top) * down, -1.0, 1.0)) / step;
    return {t.column + across, std::clamp(y, static_cast<double>(t.row), t.row + 1.0)};
}

Color EnvironmentMap::lookup(Place p) const
{
    const double left = std::floor(p.x - 0.5), top = std::floor(p.y - 0.5);
    const auto fx = static_cast<float>(p.x - 0.5 - left), fy = static_cast<float>(p.y - 0.5 - top);
    // left is -1 for the left half of the first column, whose neighbour is the last.
    const uint32_t x0 = left < 0 ? width_ - 1 : std::min(static_cast<uint32_t>(left), width_ - 1);
    const uint32_t x1 = x0 + 1 < width_ ? x0 + 1 : 0;
    const uint32_t y0 = top < 0 ? 0 : std::min(static_cast<uint32_t>(top), height_ - 1);
    const uint32_t y1 = top < 0 ? 0 : std::min(y0 + 1, height_ - 1);
    return mix(mix(texel(x0, y0), texel(x1, y0), fx), mix(texel(x0, y1), texel(x1, y1), fx), fy);
}

Color EnvironmentMap::eval(Vec3 wi) const { return lookup(place_of(wi)); }

float EnvironmentMap::pdf(Texel t) const
{
    const double* row = &in_row_[size_t{t.row} * width_];
    const double weight = row[t.column] - (t.column ? row[t.column - 1] : 0);
    return total_ > 0 ? static_cast<float>(weight / (total_ * solid_angle(t.row))) : 0;
}
float EnvironmentMap::pdf(Vec3 wi) const { return pdf(texel_of(place_of(wi))); }

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
    Texel t{};
    t.row = draw(rows_.get(), height_, lengthened(u.x, u.y) * total_, down);
    const double* row = &in_row_[size_t{t.row} * width_];
    t.column = draw(row, width_, lengthened(u.y, u.x) * row[width_ - 1], across);

    Place p = place_in(t, across, down);
    EnvironmentSample s{.wi = direction_of(p), .radiance = {}, .pdf = pdf(t)};
    Place found = place_of(s.wi);
    if (texel_of(found) != t) {
        // Rounded to beyond the border, where the density may be another: off the border by what is still a trifle.
        const auto inner = [](double x) { return std::clamp(x, 0x1p-8, 1 - 0x1p-8); };
        p = place_in(t, inner(across), inner(down));
        s.wi = direction_of(p);
        found = place_of(s.wi);
    }
    // At a pole a texel can be narrower than float tells apart; what was drawn is then as good as what is found.
    s.radiance = lookup(texel_of(found) == t ? found : p);
    return s;
}

}  // namespace lancer
