// Writes the pictures of the textured still life; the chart of materials uses some of them too.
//   g++ -std=c++20 -O2 scenes/make_still_life_textures.cpp -lpng -o make_still_life_textures &&
//   ./make_still_life_textures scenes/textures
#include "make_picture.h"

namespace {

// Five boards along u; each is cut through the rings of a tree of its own.
Rgb wood(double u, double v)
{
    constexpr int boards = 5;
    const int board = std::min(static_cast<int>(v * boards), boards - 1);
    const double in_board = v * boards - board;
    Random random(500 + static_cast<uint32_t>(board));
    const double shift = random.next(), tone = random.in(0.86, 1.08), heart = random.in(0.2, 0.8);
    const double x = u + shift, bend = 0.9 * (fractal(x * 4, in_board + 20 * shift, 3, 4, 510) - 0.5);
    const double rings = 7 * std::fabs(in_board - heart + 0.35 * bend) + 2.0 * fractal(x * 4, v * 8, 2, 4, 511);
    const double ring = rings - std::floor(rings);
    const double late = between(0.45, 0.95, ring) * (1 - between(0.95, 1.0, ring));
    const double fibre = fractal(x * 16, v * 256, 2, 16, 512);
    const double pore = between(0.80, 0.92, noise(x * 64, v * 256, 64, 513));
    Rgb c = blend({0.60, 0.42, 0.27}, {0.42, 0.27, 0.16}, 0.75 * late) * tone;
    c = c * (0.86 + 0.28 * fibre - 0.16 * pore);
    const double gap = std::fmin(in_board, 1 - in_board);
    return c * (0.35 + 0.65 * between(0.004, 0.016, gap));
}
double wood_roughness(double u, double v) { return 0.42 + 0.5 * (0.55 - wood(u, v).r); }

// Distance from (u, v) to the nearest of cells x cells scattered points, in cells; it repeats.
double cells(double u, double v, int count, uint32_t seed)
{
    double best = 9;
    const int i = static_cast<int>(std::floor(u * count)), j = static_cast<int>(std::floor(v * count));
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
            const auto wrap = [&](int k) { return static_cast<uint32_t>((k + count) % count); };
            Random random(hash(wrap(i + di) + hash(wrap(j + dj) + seed)));
            const double x = i + di + random.in(0.15, 0.85) - u * count, y = j + dj + random.in(0.15, 0.85) - v * count;
            best = std::fmin(best, std::sqrt(x * x + y * y));
        }
    return best;
}

// A plain weave, two threads each way: heights, from which the normals come.
double weave(double u, double v)
{
    const double x = u * 4, y = v * 4;
    const auto thread = [](double across) { return std::sqrt(std::fabs(std::sin(pi * across))); };
    const double sign = (static_cast<int>(std::floor(x)) + static_cast<int>(std::floor(y))) % 2 == 0 ? 1 : -1;
    const double over = 0.5 + 0.5 * sign * std::sin(pi * (x - std::floor(x))) * std::sin(pi * (y - std::floor(y)));
    return std::fmax(thread(x) * (0.3 + 0.7 * over), thread(y) * (1 - 0.7 * over));
}
void write_weave_normals(const std::string& path)
{
    constexpr int n = 64;
    Picture p(n, n, 3);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double u = (x + 0.5) / n, v = 1 - (y + 0.5) / n, h = 1.0 / n, strength = 0.055 / (2 * h);
            const auto height = [&](double a, double b) { return weave(a - std::floor(a), b - std::floor(b)); };
            const Point normal = unit({strength * (height(u - h, v) - height(u + h, v)),
                                       strength * (height(u, v - h) - height(u, v + h)), 1});
            p.set(x, y, {0.5 + 0.5 * normal.x, 0.5 + 0.5 * normal.y, 0.5 + 0.5 * normal.z});
        }
    write_png(path, p);
}

// The vase: cobalt on cream; v runs from the middle of the foot over the outside into the mouth.
Rgb vase(double u, double v)
{
    const Rgb cream{0.91, 0.88, 0.80}, cobalt{0.09, 0.17, 0.45}, light{0.36, 0.50, 0.74};
    const double wobble = 0.0025 * (fractal(u * 16, v * 16, 2, 16, 520) - 0.5) * 4;
    v += wobble;
    const auto band = [&](double a, double b) {
        return between(a - 0.002, a + 0.002, v) - between(b - 0.002, b + 0.002, v);
    };
    Rgb c = cream * (0.97 + 0.06 * fractal(u * 8, v * 8, 3, 8, 521));
    const double brush = 0.8 + 0.4 * fractal(u * 32, v * 32, 3, 32, 522);
    double ink = 0, wash = 0;
    for (const auto& [a, b] : {std::pair{0.135, 0.150}, {0.158, 0.164}, {0.565, 0.571}, {0.580, 0.600}, {0.745, 0.760}})
        ink = std::fmax(ink, band(a, b));
    // Petals that rise from the foot.
    const double petal = std::fabs(std::fmod(u * 12, 1.0) - 0.5) * 2, rise = (v - 0.17) / 0.10;
    if (rise > 0 && rise < 1) {
        const double w = 0.85 * std::sqrt(1 - rise);
        ink = std::fmax(ink, 1 - between(0.05, 0.13, std::fabs(petal - w)));
        if (petal < w - 0.12) wash = 0.55;
    }
    // Flowers about the belly, eight-leaved, and dots between them.
    const double cell = std::fmod(u * 6, 1.0) - 0.5, fx = cell * 0.95, fy = (v - 0.405) / 0.155;
    const double r = std::sqrt(fx * fx + fy * fy * 0.36) * 2.2, angle = std::atan2(fy * 0.6, fx);
    const double outline = 0.62 + 0.22 * std::cos(8 * angle);
    if (r < outline) wash = std::fmax(wash, 0.45 + 0.4 * r);
    ink = std::fmax(ink, 1 - between(0.025, 0.060, std::fabs(r - outline)));
    ink = std::fmax(ink, 1 - between(0.12, 0.16, r));
    const double dx = std::fabs(cell) - 0.5;
    for (const double at : {0.33, 0.405, 0.48}) {
        const double dy = (v - at) / 0.155 * 0.6, d = std::sqrt(dx * dx + dy * dy);
        ink = std::fmax(ink, 1 - between(0.030, 0.045, d));
    }
    // A running wave below the neck.
    const double wave = 0.655 + 0.022 * std::sin(2 * pi * 14 * u);
    ink = std::fmax(ink, 1 - between(0.006, 0.010, std::fabs(v - wave)));
    c = blend(c, light, wash * brush * 0.8);
    return blend(c, cobalt, std::fmin(1, ink * std::fmin(1.1, brush)));
}

Rgb apple(double u, double v)
{
    const double streak = fractal(u * 64, v * 4, 3, 64, 530), patch = fractal(u * 4, v * 4 + 0.5, 3, 4, 531);
    const double red = between(0.30, 0.62, 0.55 * patch + 0.45 * streak + 0.10);
    const double ends = std::fmax(1 - between(0.02, 0.20, v), between(0.86, 0.98, v));
    Rgb c = blend({0.82, 0.72, 0.30}, {0.72, 0.10, 0.10}, red * (1 - 0.8 * ends));
    return blend(c, {0.88, 0.80, 0.55}, 0.6 * (1 - between(0.10, 0.16, cells(u, v, 26, 532))));
}
Rgb pear(double u, double v)
{
    const double patch = fractal(u * 4, v * 4, 4, 4, 540), speck = 1 - between(0.10, 0.20, cells(u, v, 30, 541));
    const Rgb c = blend({0.72, 0.70, 0.26}, {0.78, 0.58, 0.26}, between(0.35, 0.65, patch));
    return blend(c, {0.45, 0.36, 0.16}, 0.55 * speck);
}

// A crocheted mat: 1 where there is thread, over the square about the circle.
double doily(double u, double v)
{
    const double x = 2 * u - 1, y = 2 * v - 1, r = std::sqrt(x * x + y * y), a = std::atan2(y, x) / (2 * pi) + 0.5;
    const auto fold = [&](double count) { return std::fabs(std::fmod(a * count, 1.0) - 0.5) * 2; };  // 0 in the middle
    const auto ring = [&](double at, double w) { return std::fabs(r - at) < w; };
    if (r > 0.985) return 0;
    if (r < 0.52) return 1;
    if (ring(0.55, 0.02) || ring(0.70, 0.018) || ring(0.855, 0.014)) return 1;
    if (r < 0.70) {  // spokes that cross
        const double t = (r - 0.55) / 0.15;
        return std::fmin(std::fabs(fold(40) - t), std::fabs(fold(40) - (1 - t))) < 0.16;
    }
    if (r < 0.855) return fold(32) > 0.62 || ring(0.775, 0.012);
    // Scallops with a hole in each.
    const double s = fold(20) * 0.135, q = r - 0.865, d = std::sqrt(s * s + q * q);
    return (d < 0.118 && d > 0.088) || d < 0.045;
}

// A window seen from within: sky, darker towards the sill, behind a cross of bars, twice.
Rgb window(double u, double v)
{
    const double bar_u = std::fabs(std::fmod(u * 2, 1.0) - 0.5), bar_v = std::fabs(std::fmod(v * 3, 1.0) - 0.5);
    const double open = (1 - between(0.462, 0.470, bar_u)) * (1 - between(0.455, 0.463, bar_v));
    const Rgb light = blend({0.80, 0.80, 0.74}, {0.90, 0.96, 1.0}, v) * (0.9 + 0.1 * fractal(u * 4, v * 4, 3, 4, 550));
    return light * open;
}

}  // namespace

int main(int argc, char** argv)
{
    const std::string folder = only_argument(argc, argv, "make_still_life_textures OUTPUT_FOLDER") + "/";
    write_color(folder + "wood.png", 512, 320, 40, wood);
    write_grey(folder + "wood_roughness.png", 512, 320, 24, wood_roughness);
    write_grey(folder + "hammered.png", 256, 256, 64, [](double u, double v) {
        const double d = cells(u, v, 9, 560);
        return std::fmin(1, 0.15 + d * d * 1.1);
    });
    write_grey(folder + "smudges.png", 256, 256, 32, [](double u, double v) {
        const double rub = fractal(u * 8 + fractal(u * 4, v * 4, 3, 4, 571), v * 4, 5, 4, 570);
        return 0.10 + 0.75 * between(0.35, 0.70, rub);
    });
    write_grey(folder + "plaster.png", 256, 256, 48,
               [](double u, double v) { return std::pow(fractal(u * 4, v * 4, 6, 4, 580), 1.3); });
    write_grey(folder + "doily.png", 512, 512, 16, [](double u, double v) {
        double sum = 0;
        for (int k = 0; k < 9; ++k) sum += doily(u + (k % 3 - 1) / 1536.0, v + (k / 3 - 1) / 1536.0);
        return sum / 9;
    });
    write_weave_normals(folder + "weave_normal.png");
    write_color(folder + "vase.png", 512, 512, 64, vase);
    write_color(folder + "apple.png", 256, 128, 40, apple);
    write_color(folder + "pear.png", 256, 128, 40, pear);
    write_color(folder + "window.png", 128, 192, 64, window);
}
