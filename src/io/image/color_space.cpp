#include "io/image/color_space.h"

namespace lancer {
namespace {

using Vector = std::array<double, 3>;

constexpr Vector operator*(const ColorMatrix& m, const Vector& v)
{
    Vector r{};
    for (size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return r;
}

constexpr ColorMatrix operator*(const ColorMatrix& a, const ColorMatrix& b)
{
    ColorMatrix r{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) r[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    return r;
}

constexpr ColorMatrix diagonal(const Vector& d) { return {{{d[0], 0, 0}, {0, d[1], 0}, {0, 0, d[2]}}}; }

constexpr ColorMatrix inverse(const ColorMatrix& m)
{
    const auto minor = [&](size_t i, size_t j) {
        const size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        return m[a][c] * m[b][d] - m[a][d] * m[b][c];
    };
    const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    ColorMatrix r{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) r[i][j] = minor(j, i) / determinant;
    return r;
}

// XYZ of luminance 1.
constexpr Vector xyz_of(const std::array<double, 2>& xy) { return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]}; }

// From RGB to XYZ, where the white, (1, 1, 1), has luminance 1.
constexpr ColorMatrix to_xyz(const Chromaticities& c)
{
    ColorMatrix primaries{};
    for (size_t j = 0; j < 3; ++j)
        for (size_t i = 0; i < 3; ++i) primaries[i][j] = xyz_of(c[j])[i];
    return primaries * diagonal(inverse(primaries) * xyz_of(c[3]));
}

constexpr ColorMatrix bradford{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

// Of XYZ: what looks white under one white point becomes what does under the other.
constexpr ColorMatrix adaptation(const std::array<double, 2>& from, const std::array<double, 2>& to)
{
    const Vector a = bradford * xyz_of(from), b = bradford * xyz_of(to);
    return inverse(bradford) * diagonal({b[0] / a[0], b[1] / a[1], b[2] / a[2]}) * bradford;
}

constexpr Chromaticities rec709{{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}};
constexpr Chromaticities ap1{{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}}};

constexpr ColorMatrix to_ap1 = inverse(to_xyz(ap1)) * adaptation(rec709[3], ap1[3]) * to_xyz(rec709);
constexpr ColorMatrix unchanged = diagonal({1, 1, 1});

}  // namespace

Chromaticities chromaticities_of(ColorSpace space) { return space == ColorSpace::acescg ? ap1 : rec709; }

ColorMatrix to_space(ColorSpace space) { return space == ColorSpace::acescg ? to_ap1 : unchanged; }
ColorMatrix from_space(ColorSpace space) { return inverse(to_space(space)); }

Color transformed(const ColorMatrix& m, Color c)
{
    const Vector v = m * Vector{c.r, c.g, c.b};
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace lancer
