// Colour spaces of FLIP: the opponent space of its filters, and the distance of two colours. Andersson, Nilsson,
// Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM
// Comput. Graph. Interact. Tech. 3(2), 2020, sections 4.1.1 to 4.1.4. Linear RGB is in [0, 1].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace lancer::flip {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

constexpr Triple operator*(const Matrix& m, const Triple& v)
{
    Triple result{};
    for (size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

constexpr Matrix inverse(const Matrix& m)
{
    Matrix adjugate{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) {
            const size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            adjugate[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    const double determinant = m[0][0] * adjugate[0][0] + m[0][1] * adjugate[1][0] + m[0][2] * adjugate[2][0];
    for (Triple& row : adjugate)
        for (double& x : row) x /= determinant;
    return adjugate;
}

// From the chromaticities of sRGB's primaries and of its white, D65 (IEC 61966-2-1); white has Y = 1.
constexpr Matrix make_xyz_from_rgb()
{
    constexpr double red[] = {0.64, 0.33}, green[] = {0.3, 0.6}, blue[] = {0.15, 0.06}, white[] = {0.3127, 0.329};
    Matrix m{{{red[0], green[0], blue[0]}, {red[1], green[1], blue[1]}, {0, 0, 0}}};
    for (size_t c = 0; c < 3; ++c) m[2][c] = 1 - m[0][c] - m[1][c];
    const Triple amounts = inverse(m) * Triple{white[0] / white[1], 1, (1 - white[0] - white[1]) / white[1]};
    for (Triple& row : m)
        for (size_t c = 0; c < 3; ++c) row[c] *= amounts[c];
    return m;
}
inline constexpr Matrix xyz_from_rgb = make_xyz_from_rgb();
inline constexpr Matrix rgb_from_xyz = inverse(xyz_from_rgb);
inline constexpr Triple white_xyz = xyz_from_rgb * Triple{1, 1, 1};

// Linear in the light: brightness Y, red against green Cx, yellow against blue Cz.
constexpr Triple opponent_from_rgb(const Triple& rgb)
{
    Triple xyz = xyz_from_rgb * rgb;
    for (size_t i = 0; i < 3; ++i) xyz[i] /= white_xyz[i];
    return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}
constexpr Triple rgb_from_opponent(const Triple& o)
{
    const double y = (o[0] + 16) / 116;
    return rgb_from_xyz * Triple{(y + o[1] / 500) * white_xyz[0], y * white_xyz[1], (y - o[2] / 200) * white_xyz[2]};
}

// CIELAB with chroma scaled by lightness, as dark colours look less saturated (Hunt effect).
inline Triple lab_from_rgb(const Triple& rgb)
{
    constexpr double delta = 6.0 / 29;
    Triple f = xyz_from_rgb * rgb;
    for (size_t i = 0; i < 3; ++i) {
        const double t = f[i] / white_xyz[i];
        f[i] = t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
    }
    const double lightness = 116 * f[1] - 16;
    return {lightness, 0.01 * lightness * 500 * (f[0] - f[1]), 0.01 * lightness * 200 * (f[1] - f[2])};
}

// Abasi, Tehran, Fairchild, "Distance metrics for very large color differences", 2020: city blocks between lightness
// and chroma, for differences that are large.
inline double hyab(const Triple& a, const Triple& b)
{
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// A distance between colours as an error in [0, 1]. The power favours small distances; then the lower 0.4 of the range
// up to the largest distance of sRGB, that of green and blue, is stretched over 0.95 of the errors.
inline double color_error(double distance)
{
    constexpr double power = 0.7, knee = 0.4, knee_error = 0.95;
    static const double largest = std::pow(hyab(lab_from_rgb({0, 1, 0}), lab_from_rgb({0, 0, 1})), power);
    const double x = std::pow(distance, power) / largest;
    return x < knee ? x * knee_error / knee : knee_error + (x - knee) / (1 - knee) * (1 - knee_error);
}

}  // namespace lancer::flip
