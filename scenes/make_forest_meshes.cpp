// Writes the meshes of the forest, grown from fixed seeds; trees in whole centimetres, small plants in millimetres.
//   g++ -std=c++20 -O2 scenes/make_forest_meshes.cpp -o make_forest_meshes && ./make_forest_meshes scenes/meshes
#include <algorithm>
#include <array>

#include "make_forest_ground.h"
#include "make_growth.h"

namespace {

constexpr double centimetre = 0.01, millimetre = 0.001;

Tube trunk(double height, double radius, int rings, double wobble, Random& random)
{
    Tube t;
    const double ax = random.spread(wobble), az = random.spread(wobble), phase = random.in(0, 6);
    for (int i = 0; i < rings; ++i) {
        const double s = static_cast<double>(i) / (rings - 1), h = height * std::pow(s, 1.4);
        const double flare = 0.55 * std::exp(-h / 0.3);
        t.axis.push_back({ax * std::sin(3 * s + phase) - ax * std::sin(phase), h - 0.3 * (i == 0),
                          az * std::sin(4 * s + phase) - az * std::sin(phase)});
        t.radius.push_back(radius * (std::pow(1 - 0.97 * h / height, 0.85) + flare));
    }
    return t;
}

// A broadleaf tree of 14 m: branches by the golden angle, each with twigs, each with cards of some nine leaves.
void write_beech(const std::string& path)
{
    Obj obj(path, "forest.mtl", centimetre, 0);
    Random random(11);
    write_card_uvs(obj);
    constexpr double height = 14;
    const Tube stem = trunk(height, 0.27, 20, 0.25, random);
    obj.material("bark");
    write_tube(obj, stem, 12, 2, 1.6);
    std::array<std::vector<Card>, 3> leaves;
    std::vector<Tube> twigs;
    constexpr int branches = 38;
    for (int i = 0; i < branches; ++i) {
        const double s = 0.34 + 0.64 * i / (branches - 1), azimuth = i * 2.39996 + random.spread(0.3);
        const double crown = std::sin(pi * std::pow(std::fmin((s - 0.20) / 0.82, 1), 0.75));
        const double reach = 0.7 + 3.6 * crown * random.in(0.8, 1.15);
        const double tilt = 1.35 - 0.95 * (s - 0.34) / 0.66;
        const double at = std::pow(s, 1 / 1.4);
        const Point base = along(stem, at), out{std::cos(azimuth), 0, std::sin(azimuth)};
        const Point direction = out * std::sin(tilt) + Point{0, std::cos(tilt), 0};
        const double thick = 0.030 + 0.016 * reach;
        const Tube branch = bent_tube(base, direction, reach, thick, 0.012, 7, 0.35 - 0.5 * (1 - s), 0.10, random);
        write_tube(obj, branch, 5, 1, 1.6);
        for (int j = 0; j < 8; ++j) {
            const double t = 0.26 + 0.74 * (j + 0.4 * random.next()) / 8;
            const Point forward = direction_at(branch, t), flat = unit(cross(forward, {0, 1, 0.01}));
            const double turn = (j % 2 ? 1 : -1) * random.in(0.6, 1.0);
            const Point way = forward * std::cos(turn) + flat * std::sin(turn) + Point{0, random.in(-0.15, 0.25), 0};
            const double size = (0.35 + 0.34 * reach * (1 - 0.6 * t)) * random.in(0.8, 1.2);
            const Tube twig = bent_tube(along(branch, t), way, size, 0.014, 0.008, 3, -0.15, 0.1, random);
            twigs.push_back(twig);
            for (int k = 0; k < 7; ++k) {
                const double q = 0.15 + 0.85 * k / 6;
                const Point f = direction_at(twig, q), r = unit(cross(f, {0, 1, 0.01}));
                const double a = k == 6 ? 0 : (k % 2 ? 1 : -1) * random.in(0.5, 1.1);
                const Point d = f * std::cos(a) + r * std::sin(a) + Point{0, random.in(-0.55, 0.1), 0};
                const double l = random.in(0.42, 0.62);
                leaves[static_cast<size_t>(random.next() * 3)].push_back(
                    leaf_card(along(twig, q), d, {0, 1, 0}, l, 0.85 * l, 0.55, random));
            }
        }
    }
    obj.material("twig");
    for (const Tube& t : twigs) write_twig(obj, t);
    for (size_t i = 0; i < leaves.size(); ++i) write_cards(obj, leaves[i], "beech_leaf_" + std::to_string(i + 1));
}

// A conifer of 17 m: whorls of drooping branches, each a spine of cards with cards to both sides.
void write_spruce(const std::string& path)
{
    Obj obj(path, "forest.mtl", centimetre, 0);
    Random random(23);
    write_card_uvs(obj);
    constexpr double height = 17;
    const Tube stem = trunk(height, 0.24, 18, 0.08, random);
    obj.material("spruce_bark");
    write_tube(obj, stem, 10, 2, 1.2);
    std::array<std::vector<Card>, 2> needles;
    std::vector<Tube> twigs;
    constexpr int whorls = 34;
    for (int w = 0; w < whorls; ++w) {
        const double s = 0.10 + 0.895 * std::pow(static_cast<double>(w) / (whorls - 1), 0.9);
        const int count = 6;
        for (int i = 0; i < count; ++i) {
            const double azimuth = 2 * pi * (i + 0.37 * w) / count + random.spread(0.25);
            const double reach = (0.25 + 2.75 * std::pow(1 - s, 0.85)) * random.in(0.75, 1.1);
            const Point out{std::cos(azimuth), 0, std::sin(azimuth)};
            const double rise = -0.35 + 1.0 * s * s + random.spread(0.1);
            const double at = std::pow(std::fmin(s + random.spread(0.012), 1), 1 / 1.4);
            const Tube branch = bent_tube(along(stem, at), out + Point{0, rise, 0}, reach, 0.014 + 0.008 * reach, 0.008,
                                          4, 0.25, 0.05, random);
            if (reach > 0.6) twigs.push_back(branch);
            std::vector<Card>& cards = needles[static_cast<size_t>(random.next() * 2)];
            const int steps = std::max(2, static_cast<int>(std::ceil(reach / 0.36)));
            for (int k = 0; k < steps; ++k) {
                const double t = (k + 0.55) / steps;
                const Point p = along(branch, t), f = direction_at(branch, t), side = unit(cross(f, {0, 1, 0.01}));
                const double size = std::fmin(0.95, 0.30 + 0.55 * reach * (1 - t) * 0.6) * random.in(0.85, 1.15);
                for (const double sign : {-1.0, 1.0}) {
                    const Point d = f * 0.62 + side * (sign * 0.8) + Point{0, random.in(-0.42, -0.08), 0};
                    cards.push_back(leaf_card(p, d, {0, 1, 0}, size, 0.42 * size + 0.10, 0.25, random));
                }
                if (k + 1 == steps) cards.push_back(leaf_card(p, f, {0, 1, 0}, 0.5, 0.36, 0.2, random));
            }
        }
    }
    for (int i = 0; i < 5; ++i)
        needles[0].push_back(leaf_card({0, height - 0.35, 0}, {std::cos(i * 1.26) * 0.5, 1.0, std::sin(i * 1.26) * 0.5},
                                       {0, 0, 1}, 0.6, 0.3, 0.5, random));
    obj.material("twig");
    for (const Tube& t : twigs) write_twig(obj, t);
    for (size_t i = 0; i < needles.size(); ++i) write_cards(obj, needles[i], "spruce_needle_" + std::to_string(i + 1));
}

// A fern of 0.9 m: fronds that arch out of one root, with leaflets to both sides that shorten to the tip.
void write_fern(const std::string& path)
{
    Obj obj(path, "forest.mtl", millimetre, 0);
    Random random(37);
    write_card_uvs(obj);
    std::vector<Card> cards;
    obj.material("fern_stalk");
    for (int i = 0; i < 18; ++i) {
        const double azimuth = i * 2.39996 + random.spread(0.2), reach = random.in(0.65, 1.0);
        const Point out{std::cos(azimuth), 0, std::sin(azimuth)};
        const double rise = random.in(0.9, 2.2);
        Tube stalk;
        Point p = out * 0.03, d = unit(out + Point{0, rise, 0});
        constexpr int rings = 11;
        for (int k = 0; k < rings; ++k) {
            stalk.axis.push_back(p);
            stalk.radius.push_back(0.005 - 0.0004 * k);
            p = p + d * (reach / (rings - 1));
            d = unit(d + out * 0.10 - Point{0, 0.07 + 0.13 * rise * k / rings, 0});
        }
        write_twig(obj, stalk);
        constexpr int pairs = 30;
        for (int k = 0; k < pairs; ++k) {
            const double t = 0.16 + 0.84 * k / pairs;
            const Point f = direction_at(stalk, t), side = unit(cross(f, {0, 1, 0.01})), up = cross(side, f);
            const double size = 0.26 * reach * std::pow(std::sin(pi * std::pow(t, 0.6) * 0.97), 0.8) + 0.02;
            for (const double sign : {-1.0, 1.0}) {
                const Point way = side * sign + f * 0.35 + up * random.in(-0.05, 0.25);
                cards.push_back(leaf_card(along(stalk, t), way, up, size, 0.30 * size + 0.012, 0.15, random));
            }
        }
    }
    write_cards(obj, cards, "fern_leaf");
}

// Grass over half a square metre, with some dry blades and a few flowers.
void write_grass(const std::string& path)
{
    Obj obj(path, "forest.mtl", millimetre, 0);
    Random random(41);
    const auto blades = [&](int count, const std::string& material, double tall) {
        obj.material(material);
        for (int i = 0; i < count; ++i) {
            const double r = 0.5 * std::sqrt(random.next()), a = random.in(0, 2 * pi), turn = random.in(0, 2 * pi);
            const double h = tall * random.in(0.45, 1.0) * (1 - 0.9 * r * r), bend = random.in(0.2, 0.9) * h;
            const double w = random.in(0.0022, 0.0042);
            const Point root{r * std::cos(a), -0.02, r * std::sin(a)}, out{std::cos(turn), 0, std::sin(turn)};
            const Point side{-out.z * w, 0, out.x * w};
            const Point middle = root + Point{0, 0.62 * h, 0} + out * (0.28 * bend);
            const Point tip = root + Point{0, 0.95 * h, 0} + out * bend;
            for (const Point p : {root - side, root + side, middle + side * 0.8, middle - side * 0.8, tip})
                obj.position(p);
            obj.face({-5, -4, -3, -2}, false, false);
            obj.face({-2, -3, -1}, false, false);
        }
    };
    blades(1150, "grass", 0.30);
    blades(520, "grass_light", 0.36);
    blades(130, "grass_dry", 0.40);
    obj.material("flower");
    for (int i = 0; i < 14; ++i) {
        const double r = 0.45 * std::sqrt(random.next()), a = random.in(0, 2 * pi), w = random.in(0.008, 0.013);
        const Point c{r * std::cos(a), random.in(0.2, 0.33), r * std::sin(a)};
        for (int k = 0; k < 5; ++k) {
            const double b = 2 * pi * k / 5;
            const Point f{std::cos(b), 0.25, std::sin(b)}, s{-std::sin(b), 0, std::cos(b)};
            for (const Point p : {c, c + (f - s * 0.5) * w, c + f * (1.6 * w), c + (f + s * 0.5) * w}) obj.position(p);
            obj.face({-4, -3, -2, -1}, false, false);
        }
    }
}

// A boulder: an icosahedron whose faces are split four times, pushed in and out.
void write_rock(const std::string& path)
{
    Obj obj(path, "forest.mtl", millimetre, 0);
    const double g = (1 + std::sqrt(5)) / 2;
    std::vector<Point> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    using Triangle = std::array<int, 3>;
    std::vector<Triangle> faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                   {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                   {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int level = 0; level < 4; ++level) {
        std::vector<std::array<int, 3>> middles;  // the lower end, the upper end, the point between
        std::vector<Triangle> finer;
        std::vector<std::vector<std::pair<int, int>>> known(points.size());
        const auto middle = [&](int a, int b) {
            if (a > b) std::swap(a, b);
            for (const auto& [end, m] : known[static_cast<size_t>(a)])
                if (end == b) return m;
            points.push_back((points[static_cast<size_t>(a)] + points[static_cast<size_t>(b)]) * 0.5);
            const int m = static_cast<int>(points.size()) - 1;
            known[static_cast<size_t>(a)].push_back({b, m});
            return m;
        };
        for (const auto& [a, b, c] : faces) {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = finer;
    }
    for (Point& p : points) {
        p = unit(p);
        // Flat facets where a plane cuts, rough in between.
        double r = 1;
        Random random(53);
        for (int i = 0; i < 13; ++i) {
            const Point n = unit({random.spread(1), random.spread(1), random.spread(1)});
            const double d = random.in(0.72, 0.93), c = dot(n, p);
            if (c > 0) r = std::fmin(r, d / c);
        }
        r += 0.10 * (fractal(p.x * 3 + 9, p.y * 3 + p.z * 2 + 9, 4, 64, 5) - 0.5) +
             0.08 * (fractal(p.z * 3 + 9, p.x * 3 - p.y * 2 + 9, 4, 64, 6) - 0.5);
        p = {p.x * r, 0.72 * p.y * r, 0.85 * p.z * r};
    }
    std::vector<Point> normals(points.size());
    for (const auto& f : faces) {
        const auto at = [&](int i) { return points[static_cast<size_t>(f[static_cast<size_t>(i)])]; };
        for (const int i : f)
            normals[static_cast<size_t>(i)] = normals[static_cast<size_t>(i)] + cross(at(1) - at(0), at(2) - at(0));
    }
    obj.material("rock");
    for (size_t i = 0; i < points.size(); ++i) {
        obj.position(points[i]);
        obj.uv(0.7 * points[i].x + 0.3 * points[i].y, 0.7 * points[i].z + 0.4 * points[i].y);
        obj.normal(unit(normals[i]));
    }
    const int count = static_cast<int>(points.size());
    for (const auto& [a, b, c] : faces) obj.face({a - count, b - count, c - count}, true, true);
}

void write_ground(const std::string& path)
{
    Obj obj(path, "forest.mtl", centimetre, 0);
    obj.material("ground");
    constexpr int n = 64;
    // Finer about the path near the eye.
    const auto x_of = [](int i) {
        const double t = 2.0 * i / n - 1;
        return ground_reach * (0.22 * t + 0.78 * t * t * t);
    };
    const auto z_of = [](int j) {
        const double t = static_cast<double>(j) / n;
        return 14 - (ground_reach + 14) * (0.30 * t + 0.70 * t * t);
    };
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const double x = x_of(i), z = z_of(j), h = 0.05;
            obj.position({x, ground(x, z), z});
            obj.uv(x, -z);
            obj.normal(unit({ground(x - h, z) - ground(x + h, z), 2 * h, ground(x, z - h) - ground(x, z + h)}));
        }
        if (j == 0) continue;
        for (int i = 0; i < n; ++i) {
            const int a = i - 2 * (n + 1), b = a + 1, c = b + n + 1, d = a + n + 1;
            obj.face({a, b, c, d}, true, true);
        }
    }
}

}  // namespace

int main(int argc, char** argv)
{
    const std::string folder = only_argument(argc, argv, "make_forest_meshes OUTPUT_FOLDER") + "/";
    write_beech(folder + "beech.obj");
    write_spruce(folder + "spruce.obj");
    write_fern(folder + "fern.obj");
    write_grass(folder + "grass.obj");
    write_rock(folder + "rock.obj");
    write_ground(folder + "ground.obj");
}
