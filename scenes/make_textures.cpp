// Writes the pictures that the scenes of this folder use: painted and grown from fixed seeds, and the sky.
//   g++ -std=c++20 -O2 scenes/make_textures.cpp -lpng -o make_textures && ./make_textures scenes/textures
#include "make_forest_ground.h"
#include "make_picture.h"

namespace {

// Half width of a pointed leaf of length 1 at `t` of its length.
double leaf_outline(double t) { return t <= 0 || t >= 1 ? 0 : 0.30 * std::pow(std::sin(pi * std::pow(t, 0.75)), 0.9); }

struct Leaf {
    double x, y, angle, size;  // foot, direction (0 is up the picture), length, all in parts of the picture
    Rgb color;
};

// Paints the leaf where (x, y) lies in it; returns its height there, or -1.
double paint_leaf(const Leaf& l, double x, double y, Rgb& color)
{
    const double c = std::cos(l.angle), s = std::sin(l.angle), dx = (x - l.x) / l.size, dy = (y - l.y) / l.size;
    const double t = dy * c + dx * s, across = dx * c - dy * s, w = leaf_outline(t);
    const double tooth = 1 + 0.07 * (std::fabs(std::fmod(t * 14, 1.0) - 0.5) - 0.25);
    if (std::fabs(across) > w * tooth) return -1;
    const double side = std::fabs(across) / 0.30;
    const double vein = std::fmod(t * 9 - side * 2.2 + 10, 1.0);
    Rgb k = l.color * (0.86 + 0.18 * between(0.0, 0.5, vein) - 0.10 * between(0.75, 1, vein));
    k = blend(k, l.color * 1.35 + Rgb{0.05, 0.06, 0.02}, 1 - between(0.006, 0.022, std::fabs(across)));
    color = k;
    return 0.4 + 0.6 * side;
}

// Where a twig starts, which way it grows (0 is up the picture) and how long it is; without leaves if bare.
struct Twig {
    double x, y, angle, size;
    bool bare = false;
};

// Twigs of a beech, each with ten leaves or none; the outline is in the picture's alpha.
void write_beech(const std::string& path, const std::vector<Twig>& twigs)
{
    Random random(201);
    std::vector<Leaf> leaves;
    for (const Twig& twig : twigs)
        for (int i = 0; i < (twig.bare ? 0 : 10); ++i) {
            const double t = i == 9 ? 0.66 : 0.02 + 0.068 * i, side = i == 9 ? 0 : (i % 2 ? 1 : -1);
            const double g = random.in(0.85, 1.12), along = t * twig.size;
            leaves.push_back({twig.x + along * std::sin(twig.angle),
                              twig.y + along * std::cos(twig.angle),
                              twig.angle + side * random.in(0.85, 1.15),
                              (i == 9 ? 0.34 : random.in(0.36, 0.42)) * twig.size,
                              {random.in(0.42, 0.52) * g, random.in(0.60, 0.66) * g, random.in(0.20, 0.26) * g}});
        }
    std::reverse(leaves.begin(), leaves.end());
    const auto is_wood = [](const Twig& twig, double x, double y) {
        const double dx = x - twig.x, dy = y - twig.y, c = std::cos(twig.angle), s = std::sin(twig.angle);
        const double t = (dy * c + dx * s) / twig.size, across = dx * c - dy * s;
        return t > 0 && t < 0.7 && std::fabs(across - 0.01 * twig.size * std::sin(9 * t)) < 0.008;
    };
    Picture p = cut_out(256, 256, {0.47, 0.62, 0.23}, [&](double x, double y, Rgb& c) {
        for (const Leaf& l : leaves)
            if (paint_leaf(l, x, y, c) >= 0) return true;
        c = {0.33, 0.25, 0.17};
        return std::any_of(twigs.begin(), twigs.end(), [&](const Twig& twig) { return is_wood(twig, x, y); });
    });
    write_png(path, p, 64);
}

// A spray of spruce: a twig with side twigs, all with needles. Its mask is a picture of its own.
void write_spruce(const std::string& picture, const std::string& mask)
{
    struct Needle {
        double x0, y0, x1, y1, shade;
    };
    std::vector<Needle> needles, wood;
    Random random(202);
    const auto spray = [&](double x, double y, double angle, double size) {
        wood.push_back({x, y, x + size * std::sin(angle), y + size * std::cos(angle), 0.5});
        const int count = static_cast<int>(size * 210);
        for (int i = 0; i < count; ++i) {
            const double t = static_cast<double>(i) / count, side = i % 2 ? 1 : -1;
            const double a = angle + side * random.in(0.55, 0.95) * (1 - 0.5 * t * t);
            const double l = random.in(0.085, 0.115) * (1 - 0.35 * t);
            const double px = x + t * size * std::sin(angle), py = y + t * size * std::cos(angle);
            needles.push_back({px, py, px + l * std::sin(a), py + l * std::cos(a), random.in(0.7, 1.25)});
        }
    };
    spray(0.5, 0, 0, 0.93);
    for (int i = 0; i < 8; ++i)
        spray(0.5, 0.06 + 0.085 * i, (i % 2 ? 1 : -1) * random.in(0.7, 0.9), 0.50 * (1 - 0.085 * i));
    const auto near = [](const Needle& n, double x, double y) {
        const double dx = n.x1 - n.x0, dy = n.y1 - n.y0, l2 = dx * dx + dy * dy;
        const double t = std::clamp(((x - n.x0) * dx + (y - n.y0) * dy) / l2, 0.0, 1.0);
        const double ex = x - n.x0 - t * dx, ey = y - n.y0 - t * dy;
        return std::sqrt(ex * ex + ey * ey) / (1 - 0.5 * t);
    };
    Picture p = cut_out(192, 192, {0.27, 0.40, 0.21}, [&](double x, double y, Rgb& c) {
        for (const Needle& n : wood)
            if (near(n, x, y) < 0.008) {
                c = {0.36, 0.27, 0.18};
                return true;
            }
        for (const Needle& n : needles)
            if (near(n, x, y) < 0.0085) {
                c = Rgb{0.29, 0.42, 0.22} * n.shade;
                return true;
            }
        return false;
    });
    Picture color(p.width, p.height, 3), outline(p.width, p.height, 1);
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            color.set(x, y, {p.at(x, y, 0), p.at(x, y, 1), p.at(x, y, 2)});
            outline.at(x, y, 0) = p.at(x, y, 3);
        }
    write_png(picture, color, 32);
    write_png(mask, outline, 16);
}

// One leaflet of a fern, itself lobed to both sides.
void write_fern_mask(const std::string& path)
{
    Picture p = cut_out(64, 256, {1, 1, 1}, [](double x, double y, Rgb& c) {
        const double off = std::fabs(x - 0.5) * 2, reach = std::pow(1 - y, 0.55) * 0.97;
        const double lobe = std::fabs(std::fmod(y * 15 - off * 1.6 + 5, 1.0) - 0.5) * 2;  // 0 in the middle of a lobe
        c = {1, 1, 1};
        return off < 0.10 * (1.1 - y) || (off < reach && lobe < std::sqrt(std::fmax(0, 1 - off / reach)) * 0.55 + 0.36);
    });
    Picture outline(p.width, p.height, 1);
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) outline.at(x, y, 0) = p.at(x, y, 3);
    write_png(path, outline, 16);
}

// Bark: ridges along the trunk, torn by noise. Used as colour and as height.
void write_bark(const std::string& path)
{
    Picture p(256, 256, 1);
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const double u = x / 256.0, v = y / 256.0;
            const double warp = 0.9 * (fractal(u * 8, v * 8, 4, 8, 301) - 0.5);
            const double ridge = std::fabs(2 * noise((u + 0.09 * warp) * 16, v * 4 + warp, 4 * 4, 302) - 1);
            const double fine = fractal(u * 32, v * 16, 3, 16, 303);
            p.at(x, y, 0) = 0.30 + 0.52 * std::pow(ridge, 0.55) + 0.34 * (fine - 0.5);
        }
    write_png(path, p, 48);
}

// Fallen leaves on the ground, and their heights.
void write_litter(const std::string& picture, const std::string& height)
{
    constexpr int n = 320;
    Picture color(n, n, 3), bump(n, n, 1);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) color.set(x, y, {0.20, 0.15, 0.11});
    Random random(204);
    constexpr std::array<Rgb, 6> browns = {Rgb{0.42, 0.29, 0.17}, {0.50, 0.36, 0.21}, {0.34, 0.23, 0.15},
                                           {0.56, 0.43, 0.27},    {0.45, 0.27, 0.14}, {0.30, 0.25, 0.17}};
    constexpr int count = 620;
    for (int i = 0; i < count; ++i) {
        Leaf l{random.next(), random.next(), random.in(0, 2 * pi), random.in(0.07, 0.12),
               browns[static_cast<size_t>(random.next() * 6)] * random.in(0.75, 1.1)};
        const double base = 0.15 + 0.6 * i / count;
        const int reach = static_cast<int>(l.size * n) + 1, cx = static_cast<int>(l.x * n),
                  cy = static_cast<int>(l.y * n);
        for (int y = cy - reach; y <= cy + reach; ++y)
            for (int x = cx - reach; x <= cx + reach; ++x) {
                Rgb c;
                const double h = paint_leaf(l, (x + 0.5) / n, (y + 0.5) / n, c);
                if (h < 0) continue;
                color.set((x + n) % n, (y + n) % n, c);
                bump.at((x + n) % n, (y + n) % n, 0) = base + 0.18 * h;
            }
    }
    write_png(picture, color, 32);
    write_png(height, bump, 48);
}

// Where the forest's path is trodden: white, over x from -25 to 25 and z from 5 (below) to -45 (above).
void write_path_mask(const std::string& path)
{
    constexpr int n = 512;
    Picture p(n, n, 1);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double px = -25 + 50 * (x + 0.5) / n, pz = -45 + 50 * (y + 0.5) / n;
            const double off = std::fabs(px - path_x(pz));
            const double torn = 0.9 * (fractal(px * 1.3 + 70, pz * 1.3 + 70, 4, 512, 205) - 0.5);
            p.at(x, y, 0) = 0.92 * (1 - between(0.40, 1.05, off + torn));
        }
    write_png(path, p, 32);
}

// Moss on stones, earth between grass: noise with soft edges.
void write_patches(const std::string& path)
{
    Picture p(256, 256, 1);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) p.at(x, y, 0) = between(0.40, 0.62, fractal(x / 32.0, y / 32.0, 5, 8, 206));
    write_png(path, p, 32);
}

// Radiance (RGBE), run-length coded; `radiance` gets unit directions.
void write_hdr(const std::string& path, int width, int height, const std::function<Rgb(Point)>& radiance)
{
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file) fail(path);
    std::fprintf(file, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", height, width);
    std::vector<std::array<unsigned char, 4>> row(static_cast<size_t>(width));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Rgb sum;
            constexpr int side = 4;  // places along each side of a pixel
            for (int k = 0; k < side * side; ++k) {
                const double phi = pi - 2 * pi * (x + (k % side + 0.5) / side) / width;
                const double theta = pi * (y + (k / side + 0.5) / side) / height;
                sum =
                    sum + radiance({std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)});
            }
            const Rgb c = sum * (1.0 / (side * side));
            int exponent = 0;
            std::frexp(std::max({c.r, c.g, c.b}), &exponent);
            const double scale = std::ldexp(256, -exponent);
            const auto byte = [&](double v) { return static_cast<unsigned char>(std::min(v * scale, 255.0)); };
            row[static_cast<size_t>(x)] = {byte(c.r), byte(c.g), byte(c.b), static_cast<unsigned char>(exponent + 128)};
        }
        const std::array<int, 4> head = {2, 2, width >> 8, width & 255};
        for (const int c : head) std::fputc(c, file);
        for (size_t c = 0; c < 4; ++c)
            for (size_t x = 0; x < row.size();) {
                const auto run_at = [&](size_t from) {
                    size_t n = 1;
                    while (from + n < row.size() && n < 127 && row[from + n][c] == row[from][c]) ++n;
                    return n;
                };
                const size_t run = run_at(x);
                if (run >= 3) {
                    std::fputc(static_cast<int>(128 + run), file);
                    std::fputc(row[x][c], file);
                    x += run;
                    continue;
                }
                size_t end = x;
                while (end < row.size() && end - x < 128 && run_at(end) < 3) ++end;
                std::fputc(static_cast<int>(end - x), file);
                for (; x < end; ++x) std::fputc(row[x][c], file);
            }
    }
    if (std::fclose(file) != 0) fail(path);
}

// A clear afternoon with high clouds: the blue deepens towards the zenith, brightens around the sun and pales at the
// horizon. The sun is a disc as wide as three pixels; it lights level ground five times as much as the rest of the sky.
// Below the horizon there is dull ground.
const Point sun = unit({-0.62, 0.62, 0.48});
Rgb sky(Point d)
{
    const double c = dot(d, sun), up = d.y;
    constexpr double disc = 0.0105;  // radius in radians
    if (up < 0) return Rgb{0.085, 0.078, 0.066};
    const double haze = std::exp(-up / 0.10), around = std::exp((c - 1) / 0.06), wide = std::exp((c - 1) / 0.4);
    Rgb k = blend(Rgb{0.16, 0.30, 0.62}, Rgb{0.34, 0.50, 0.76}, std::exp(-up / 0.35));
    k = blend(k, {0.74, 0.78, 0.82}, 0.8 * haze);
    k = k + Rgb{0.9, 0.72, 0.48} * (0.55 * around) + Rgb{0.30, 0.28, 0.24} * wide;
    // Clouds lie on a plane above; they thin out towards the horizon, where that plane is far.
    const double px = d.x / (up + 0.12), pz = d.z / (up + 0.12);
    const double warp = 1.2 * fractal(px * 0.8 + 90, pz * 0.8 + 90, 3, 512, 402);
    const double cover = between(0.50, 0.78, fractal(px * 0.9 + warp + 90, pz * 1.7 + warp + 90, 6, 512, 401));
    const double lit = 0.75 + 0.5 * wide + 1.4 * around;
    k = blend(k, Rgb{1.0, 0.97, 0.93} * lit, 0.85 * cover * between(0.0, 0.22, up));
    if (c > std::cos(disc)) k = k + Rgb{1.0, 0.90, 0.74} * 4.0e4;
    return k;
}

// An evening: the sun stands twelve degrees above a glowing horizon, under clouds that it lights from below. d: z up.
Rgb evening(Point d)
{
    const Point low_sun = unit({0.62, -0.75, 0.207});
    const double c = dot(d, low_sun), up = std::fmax(d.z, 0), towards = std::exp((c - 1) / 0.5);
    Rgb k = blend({0.05, 0.09, 0.24}, {0.30, 0.40, 0.58}, std::exp(-up / 0.35));
    k = blend(k, blend({0.62, 0.42, 0.36}, {1.0, 0.62, 0.25}, towards), std::exp(-up / 0.16));
    k = k + Rgb{0.9, 0.55, 0.2} * (0.5 * std::exp((c - 1) / 0.03));
    const double px = d.x / (up + 0.18), py = d.y / (up + 0.18);
    const double warp = fractal(px * 0.7 + 90, py * 0.7 + 90, 2, 512, 502);
    const double cover = between(0.46, 0.74, fractal(px * 0.8 + warp + 90, py * 1.3 + warp + 90, 4, 512, 501));
    k = blend(k, blend({0.22, 0.20, 0.27}, {1.0, 0.72, 0.46}, towards), 0.8 * cover * between(0.02, 0.25, up));
    return blend(k, {1, 1, 1}, between(std::cos(0.030), std::cos(0.024), c));
}

// As through a fish-eye that looks up: the angle to the zenith grows evenly from the middle to the rim, which ends 15
// pixels from the edges; +x is on the right, +y below. Black outside.
void write_fish_eye_sky(const std::string& path)
{
    constexpr int n = 480, side = 3;
    Picture p(n, n, 3);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            Rgb sum;
            for (int k = 0; k < side * side; ++k) {
                const double dx = x + (k % side + 0.5) / side - n / 2.0, dy = y + (k / side + 0.5) / side - n / 2.0;
                const double angle = pi / 2 * std::hypot(dx, dy) / (n / 2.0 - 15), azimuth = std::atan2(dy, dx);
                // What lies beyond the rim is black from two pixels on: looking up at the rim mixes in what is next.
                if (angle > pi / 2 * 1.01) continue;
                sum = sum + evening({std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                                     std::cos(angle)});
            }
            const auto encoded = [&](double v) { return std::pow(std::clamp(v / (side * side), 0.0, 1.0), 1 / 2.2); };
            p.set(x, y, {encoded(sum.r), encoded(sum.g), encoded(sum.b)});
        }
    write_png(path, p);
}

}  // namespace

int main(int argc, char** argv)
{
    const std::string folder = only_argument(argc, argv, "make_textures OUTPUT_FOLDER") + "/";
    write_beech(folder + "beech.png", {{0.5, 0, 0, 1}});
    write_beech(folder + "beech_spray.png", {{0.5, 0.56, 0, 0.44},
                                             {0.5, 0.46, 0.8, 0.42},
                                             {0.5, 0.36, -0.8, 0.44},
                                             {0.5, 0.22, 0.95, 0.46},
                                             {0.5, 0.10, -1.0, 0.47},
                                             {0.5, 0.0, 1.15, 0.42},
                                             {0.5, 0.0, 0.0, 0.85, true}});
    write_spruce(folder + "spruce.png", folder + "spruce_mask.png");
    write_fern_mask(folder + "fern_mask.png");
    write_bark(folder + "bark.png");
    write_litter(folder + "litter.png", folder + "litter_height.png");
    write_path_mask(folder + "path_mask.png");
    write_patches(folder + "patches.png");
    write_hdr(folder + "sky.hdr", 1024, 512, sky);
    write_fish_eye_sky(folder + "evening_fish_eye.png");
}
