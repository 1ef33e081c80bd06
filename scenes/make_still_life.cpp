// Writes the meshes of the textured still life, in centimetres.
//   g++ -std=c++20 -O2 scenes/make_still_life.cpp -o make_still_life && ./make_still_life scenes/meshes
#include "make_growth.h"

namespace {

using Profile = std::vector<std::array<double, 2>>;  // radius and height, in centimetres

// A smooth curve through the points (Catmull-Rom), at t in [0, 1].
std::array<double, 2> at(const Profile& p, double t)
{
    const int last = static_cast<int>(p.size()) - 1;
    const double s = t * last;
    const int i = std::min(static_cast<int>(s), last - 1);
    const double f = s - i;
    std::array<double, 2> r{};
    for (size_t c = 0; c < 2; ++c) {
        const auto v = [&](int k) { return p[static_cast<size_t>(std::clamp(k, 0, last))][c]; };
        const double a = v(i - 1), b = v(i), d = v(i + 1), e = v(i + 2);
        r[c] = b + 0.5 * f * (d - a + f * (2 * a - 5 * b + 4 * d - e + f * (3 * (b - d) + e - a)));
    }
    r[0] = std::fmax(r[0], 0);
    return r;
}

// Turned about the y axis; seen from outside, u runs to the right and v along the profile by its length. The profile
// runs upwards where its outside is away from the axis.
void lathe(Obj& obj, const Profile& profile, int around, int along, bool uvs)
{
    std::vector<double> lengths(1, 0);
    constexpr int steps = 400;
    for (int k = 1; k <= steps; ++k) {
        const auto a = at(profile, (k - 1.0) / steps), b = at(profile, static_cast<double>(k) / steps);
        lengths.push_back(lengths.back() + std::hypot(b[0] - a[0], b[1] - a[1]));
    }
    int place = 0;
    for (int j = 0; j <= along; ++j) {
        // Rings at equal distances along the profile.
        const double wanted = lengths.back() * j / along;
        while (place < steps - 1 && lengths[static_cast<size_t>(place + 1)] < wanted) ++place;
        const double l0 = lengths[static_cast<size_t>(place)], l1 = lengths[static_cast<size_t>(place + 1)];
        const double t = (place + std::clamp((wanted - l0) / (l1 - l0), 0.0, 1.0)) / steps, h = 1e-3;
        const auto here = at(profile, t);
        const auto before = at(profile, std::fmax(t - h, 0)), after = at(profile, std::fmin(t + h, 1));
        const double dr = after[0] - before[0], dy = after[1] - before[1], l = std::hypot(dr, dy);
        for (int k = 0; k <= around; ++k) {
            const double a = 2 * pi * (k % around) / around, c = std::cos(a), s = std::sin(a);
            obj.position({here[0] * c, here[1], here[0] * s});
            if (uvs) obj.uv(1 - static_cast<double>(k) / around, static_cast<double>(j) / along);
            obj.normal({dy / l * c, -dr / l, dy / l * s}, 3);
        }
        if (j == 0) continue;
        const int row = around + 1;
        for (int k = 0; k < around; ++k) {
            const int a = k - 2 * row, b = a + row;
            if (j == 1 && here[0] > 0 && at(profile, 0)[0] == 0)
                obj.face({a, b, b + 1}, uvs, true);
            else if (here[0] == 0)
                obj.face({a, b, a + 1}, uvs, true);
            else
                obj.face({a, b, b + 1, a + 1}, uvs, true);
        }
    }
}

void write_lathe(const std::string& path, const Profile& profile, int around, int along, bool uvs = true)
{
    Obj obj(path, "", 1, 2);
    lathe(obj, profile, around, along, uvs);
}

// Twigs of beech that stand in the vase, whose mouth is at the origin.
void write_twigs(const std::string& path)
{
    Obj obj(path, "forest.mtl", 1, 2);
    Random random(61);
    write_card_uvs(obj);
    std::vector<Card> cards;
    obj.material("twig");
    for (int i = 0; i < 6; ++i) {
        const double azimuth = 0.5 + i * 2.39996, reach = random.in(21, 29), arch = random.in(0.03, 0.11);
        const Point out{std::cos(azimuth), 0, 0.7 * std::sin(azimuth)};
        Tube stem;
        Point p{out.x * 0.6, -9, out.z * 0.6}, d = unit(out * 0.12 + Point{0, 1, 0});
        constexpr int rings = 11;
        for (int k = 0; k < rings; ++k) {
            stem.axis.push_back(p);
            stem.radius.push_back(0.20 - 0.014 * k);
            p = p + d * (reach / (rings - 1));
            d = unit(d + out * (k < 3 ? 0 : arch) + Point{random.spread(0.06), 0, random.spread(0.06)});
        }
        write_twig(obj, stem);
        for (int k = 0; k < 8; ++k) {
            const double t = 0.46 + 0.54 * k / 7;
            const Point f = direction_at(stem, t), r = across(f, {random.spread(1), 0.2, random.spread(1)});
            const Point way = k == 7 ? f : f * 0.6 + r * 0.8;
            const double size = random.in(5.5, 7.5) * (1 - 0.25 * t);
            cards.push_back(leaf_card(along(stem, t), way, {0.2, 0.6, 0.75}, size, 0.85 * size, 0.5, random));
        }
    }
    write_cards(obj, cards, "beech_twig");
}

// A cloth on the table that hangs over its front edge, at z = 0; uv in centimetres over its length and width.
void write_cloth(const std::string& path)
{
    Obj obj(path, "", 1, 2);
    constexpr int nu = 40, nv = 50;
    constexpr double wide = 46, deep = 26, hang = 16, edge = 1.0;  // edge: radius of the bend
    const auto surface = [&](double u, double v) -> Point {
        const double x = wide * (u - 0.5), s = (deep + hang) * v, arc = edge * pi / 2;
        const double folds = 0.10 * std::sin(0.55 * x + 0.5 * std::sin(0.22 * s)) + 0.06 * std::sin(0.9 * x + 0.25 * s);
        if (s < deep) return {x, 0.15 + 0.5 * (folds + 0.12) * between(4, 22, s), -deep + s};
        const double down = std::fmax(0, s - deep - arc), b = std::fmin((s - deep) / edge, pi / 2);
        const double swing = (folds + 0.10) * (0.9 + 0.45 * down);
        return {x + 0.02 * down * folds * 10, 0.15 + swing * 0.5 * std::cos(b) - edge * (1 - std::cos(b)) - down,
                0.1 + edge * std::sin(b) + std::sin(b) * std::fmax(swing, -0.02)};
    };
    for (int j = 0; j <= nv; ++j) {
        for (int i = 0; i <= nu; ++i) {
            const double u = static_cast<double>(i) / nu, v = static_cast<double>(j) / nv, h = 1e-3;
            const Point du = surface(u + h, v) - surface(u - h, v), dv = surface(u, v + h) - surface(u, v - h);
            obj.position(surface(u, v));
            obj.uv(wide * u, (deep + hang) * (1 - v));
            obj.normal(unit(cross(dv, du)), 3);
        }
        if (j == 0) continue;
        for (int i = 0; i < nu; ++i) {
            const int a = i - 2 * (nu + 1), b = a + nu + 1;
            obj.face({a, b, b + 1, a + 1}, true, true);
        }
    }
}

// A flat piece with uvs in centimetres, for walls, boards and windows: x by y, its face to +z.
void write_panel(const std::string& path, double width, double height, double uv_width, double uv_height)
{
    Obj obj(path, "", 1, 2);
    for (const double y : {0.0, 1.0})
        for (const double x : {-0.5, 0.5}) {
            obj.position({x * width, y * height, 0});
            obj.uv((x + 0.5) * uv_width, y * uv_height);
        }
    obj.face({-4, -3, -1, -2}, true, false);
}

}  // namespace

int main(int argc, char** argv)
{
    const std::string folder = only_argument(argc, argv, "make_still_life OUTPUT_FOLDER") + "/";
    write_lathe(folder + "vase.obj",
                {{0, 0},
                 {3.6, 0},
                 {4.6, 0.6},
                 {7.4, 7},
                 {7.6, 12.5},
                 {4.6, 18},
                 {2.9, 20.6},
                 {3.5, 23},
                 {3.7, 23.3},
                 {3.3, 23.2},
                 {2.4, 20.6},
                 {3.6, 18},
                 {5, 14}},
                48, 54);
    write_lathe(folder + "bowl.obj",
                {{0, 1.0},
                 {3.0, 0.9},
                 {3.6, 0},
                 {4.0, 0.1},
                 {4.6, 1.2},
                 {9.5, 4.0},
                 {12.6, 8.2},
                 {12.9, 8.6},
                 {12.4, 8.5},
                 {9.0, 4.5},
                 {4.5, 1.9},
                 {0, 1.5}},
                48, 40);
    write_lathe(folder + "bottle.obj",
                {{0, 0.8},    {2.5, 0.3},  {4.0, 0},    {4.5, 0.7},  {4.5, 5},    {4.5, 11},   {4.3, 15}, {2.2, 18.5},
                 {1.6, 21},   {1.6, 25.5}, {1.9, 25.8}, {1.9, 26.8}, {1.6, 27.0}, {1.2, 26.6}, {1.2, 21}, {1.8, 18.3},
                 {3.9, 14.8}, {4.1, 11},   {4.1, 5},    {4.1, 1.6},  {2.5, 1.0},  {0, 1.3}},
                40, 66, false);
    write_lathe(folder + "goblet.obj",
                {{0, 0},
                 {3.3, 0},
                 {3.5, 0.15},
                 {3.2, 0.35},
                 {1.0, 0.8},
                 {0.5, 2},
                 {0.45, 5.5},
                 {0.9, 7},
                 {3.2, 9},
                 {4.0, 12},
                 {3.5, 16.4},
                 {3.4, 16.5},
                 {3.3, 16.4},
                 {3.75, 12},
                 {3.0, 9.2},
                 {0.9, 7.7},
                 {0, 7.5}},
                40, 60, false);
    write_lathe(folder + "apple.obj",
                {{0, 0.7},
                 {0.6, 0.45},
                 {1.5, 0},
                 {2.6, 0.7},
                 {3.6, 2.6},
                 {3.8, 4.4},
                 {3.0, 6.2},
                 {1.6, 6.7},
                 {0.6, 6.2},
                 {0, 5.6}},
                32, 26);
    write_lathe(folder + "pear.obj",
                {{0, 0.5},
                 {0.8, 0.2},
                 {2, 0.2},
                 {3.3, 1.6},
                 {3.6, 3.4},
                 {2.8, 5.6},
                 {1.7, 7.6},
                 {1.4, 9},
                 {0.8, 9.9},
                 {0, 9.9}},
                32, 26);
    write_lathe(folder + "mug.obj",
                {{0, 0.3},
                 {3.2, 0.25},
                 {3.5, 0},
                 {3.9, 0.3},
                 {4.0, 1.0},
                 {3.6, 4.5},
                 {3.7, 8.4},
                 {4.0, 9},
                 {3.8, 9.1},
                 {3.5, 8.4},
                 {3.4, 4.5},
                 {3.7, 1.2},
                 {3, 0.8},
                 {0, 0.8}},
                40, 40);
    write_lathe(folder + "stick.obj", {{0, 0}, {0.16, 0}, {0.2, 0.1}, {0.12, 1.0}, {0.16, 1.9}, {0.1, 2.0}, {0, 2.0}},
                8, 12, false);
    write_twigs(folder + "twigs.obj");
    write_cloth(folder + "cloth.obj");
    write_panel(folder + "panel.obj", 100, 100, 1, 1);
}
