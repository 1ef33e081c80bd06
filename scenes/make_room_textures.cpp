// Writes the pictures of the living room and the bathroom.
//   g++ -std=c++20 -O2 scenes/make_room_textures.cpp -lpng -o make_room_textures &&
//   ./make_room_textures scenes/textures
#include "make_picture.h"

namespace {

// A board cut beside the heart of its tree; u runs along it and v across, both repeat after 1.
Rgb oak_board(double u, double v, uint32_t seed, double heart, double slope)
{
    const double bend = fractal(u * 2, v * 2, 3, 2, seed) - 0.5, d = v - heart + slope * (u - 0.5);
    const double rings = 5.5 * std::sqrt(d * d + 0.02) + 1.5 * bend;
    const double ring = rings - std::floor(rings);
    const double late = between(0.2, 0.9, ring) * (1 - between(0.93, 1.0, ring));
    const double fibre = fractal(u * 8, v * 64, 3, 8, seed + 1),
                 pore = between(0.70, 0.9, noise(u * 24, v * 128, 24, seed + 2));
    const Rgb c = blend({0.76, 0.60, 0.43}, {0.60, 0.43, 0.28}, 0.8 * late);
    return c * (0.88 + 0.20 * fibre - 0.14 * pore * (0.4 + 0.6 * late));
}

// A floor of eight rows of boards, which end where their neighbours do not.
Rgb planks(double u, double v)
{
    constexpr int rows = 8;
    const int row = std::min(static_cast<int>(v * rows), rows - 1);
    const double across = v * rows - row, shift = noise(row * 0.37 + 0.2, 0.5, 64, 600), along = (u + shift) * 2;
    const int board = (static_cast<int>(std::floor(along)) % 2) + 2 * row;
    Random random(610 + static_cast<uint32_t>(board));
    const double tone = random.in(0.72, 1.0), red = random.in(0.97, 1.03), heart = random.in(-0.3, 1.3);
    const double x = along - std::floor(along);
    Rgb c = oak_board(0.5 * x + 0.5 * random.next(), 0.25 * across + 0.75 * random.next(),
                      620 + static_cast<uint32_t>(board), 0.25 * heart, random.spread(0.06)) *
            tone;
    c = {c.r * red, c.g * 0.97, c.b * 0.92 / red};
    const double gap = std::fmin(std::fmin(across, 1 - across) * 0.3, std::fmin(x, 1 - x) * 1.2);  // in metres
    return c * (0.30 + 0.70 * between(0.0006, 0.0035, gap));
}

// Hills behind hills under an evening sky, in flat colours.
Rgb painting(double u, double v)
{
    Rgb c = blend({0.95, 0.80, 0.58}, {0.50, 0.62, 0.68}, between(0.45, 1.0, v));
    const double sx = (u - 0.68) * 1.6, sy = v - 0.70;
    c = blend({0.93, 0.45, 0.25}, c, between(0.098, 0.102, std::sqrt(sx * sx + sy * sy)));
    const std::array<Rgb, 5> hills{
        Rgb{0.62, 0.66, 0.66}, {0.42, 0.54, 0.55}, {0.28, 0.42, 0.43}, {0.62, 0.45, 0.28}, {0.17, 0.26, 0.27}};
    for (size_t k = 0; k < hills.size(); ++k) {
        const double n = static_cast<double>(k),
                     top = 0.60 - 0.115 * n +
                           0.16 *
                               (fractal(u * (1.5 + 0.5 * n) + 3 * n, 0.5, 3, 64, 630 + static_cast<uint32_t>(k)) - 0.5);
        c = blend(hills[k] * (0.94 + 0.12 * fractal(u * 32, v * 32, 3, 32, 640)), c,
                  between(top - 0.003, top + 0.003, v));
    }
    return c * (0.96 + 0.08 * fractal(u * 64, v * 64, 2, 64, 641));
}

// A woven rug: a border, and rows of diamonds in wool.
Rgb rug(double u, double v)
{
    const Rgb ground{0.80, 0.74, 0.64}, dark{0.30, 0.33, 0.36}, rust{0.66, 0.36, 0.24};
    const double x = u * 26, y = v * 18, edge = std::fmin(std::fmin(x, 26 - x), std::fmin(y, 18 - y));
    Rgb c = ground;
    const auto fold = [](double t) { return std::fabs(t - std::floor(t) - 0.5) * 2; };
    if (edge < 0.5)
        c = dark;
    else if (edge > 0.9 && edge < 1.15)
        c = rust;
    else if (edge > 1.6) {
        const double d = fold(x / 4 + 0.25) + fold(y / 4 + 0.25);
        if (std::fabs(d - 1) < 0.10) c = dark;
        if (d < 0.34 || d > 1.66) c = rust;
    }
    const double thread = 0.5 + 0.5 * std::sin(2 * pi * v * 128) * (0.6 + 0.4 * std::sin(2 * pi * u * 96));
    return c * (0.80 + 0.16 * thread + 0.12 * (fractal(u * 16, v * 64, 3, 16, 650) - 0.5));
}

// Six-sided floor tiles, three and four in a picture; some are dark.
Rgb hexagons(double u, double v)
{
    // Nearest centre of a lattice of period (1, 2) in units of a tile's width, stretched a little to repeat.
    const double x = u * 16, y = v * 18 * std::sqrt(3) / 2 * (2 / std::sqrt(3));
    double best = 9, second = 9;
    int tile = 0;
    for (int j = static_cast<int>(std::floor(y)) - 1; j <= static_cast<int>(std::floor(y)) + 2; ++j)
        for (int i = static_cast<int>(std::floor(x)) - 1; i <= static_cast<int>(std::floor(x)) + 2; ++i) {
            const double dx = i + 0.5 * (((j % 2) + 2) % 2) - x, dy = (j - y) * std::sqrt(3) / 2,
                         d = std::sqrt(dx * dx + dy * dy);
            if (d < best)
                second = best, best = d, tile = (((i % 16) + 16) % 16) + 16 * (((j % 18) + 18) % 18);
            else
                second = std::fmin(second, d);
        }
    Random random(670 + static_cast<uint32_t>(tile));
    const int i = tile % 16, j = tile / 16;
    const bool dark = j % 6 == 0 && (2 * i + j) % 8 == 0;
    const Rgb glaze = (dark ? Rgb{0.26, 0.33, 0.35} : Rgb{0.90, 0.89, 0.86}) * random.in(0.94, 1.03);
    return blend({0.60, 0.59, 0.56}, glaze, between(0.035, 0.075, second - best));
}

}  // namespace

int main(int argc, char** argv)
{
    const std::string folder = only_argument(argc, argv, "make_room_textures OUTPUT_FOLDER") + "/";
    write_color(folder + "planks.png", 768, 768, 40, planks);
    write_color(folder + "oak.png", 384, 256, 40, [](double u, double v) { return oak_board(u, v, 660, 0.4, 0.0); });
    write_color(folder + "painting.png", 288, 180, 48, painting);
    write_color(folder + "hexagons.png", 512, 512, 40, hexagons);
    write_color(folder + "rug.png", 416, 288, 32, rug);
}
