// Writes the courtyard of atrium.toml, in millimetres: arcades with vaults below, galleries with balustrades above.
//   g++ -std=c++20 -O2 scenes/make_atrium.cpp -o make_atrium && ./make_atrium scenes/meshes
#include "make_rooms.h"

namespace {

constexpr double bay = 3, spring = 2.7, arch = 1.21, floor_2 = 4.55, column_2 = 2.55, top = 7.9, thick = 0.25;

// A side of the court: its columns stand along x, the court is where z is positive, the gallery where it is not.
struct Side {
    Point middle;
    double turn;
    int bays;
};
constexpr std::array<Side, 4> sides{
    Side{{0, 0, -9}, 0, 4}, {{0, 0, 9}, 180, 4}, {{-6, 0, 0}, 90, 6}, {{6, 0, 0}, -90, 6}};

Pieces::Profile column(double height, double r)
{
    Pieces::Profile p{{0, 0},
                      {1.38 * r, 0},
                      {1.45 * r, 0.2 * r},
                      {1.36 * r, 0.42 * r},
                      {1.15 * r, 0.5 * r},
                      {1.22 * r, 0.72 * r},
                      {1.02 * r, r}};
    const double low = r, high = height - 1.35 * r;
    for (int k = 1; k <= 4; ++k) {  // the shaft, which swells and tapers
        const double t = k / 4.0;
        p.push_back({r * (1 - 0.16 * t * t), low + (high - low) * t});
    }
    for (const auto& [x, y] : {std::array{0.98, 0.08}, {0.87, 0.22}, {0.90, 0.60}, {1.06, 1.0}, {1.38, 1.35}})
        p.push_back({x * r, high + y * r});
    return p;
}

// An arch from (0, spring) to (bay, spring) in a wall that reaches to `above`, and the moulding about it.
void arch_in_wall(Pieces& p, Point at, double above)
{
    constexpr int steps = 16;
    const auto on = [&](double r, double u, double z) {
        const double a = pi * (1 - u);
        return at + Point{bay / 2 + r * std::cos(a), spring + r * std::sin(a), z};
    };
    p.material("plaster");
    for (const double side : {1.0, -1.0}) {
        const double z = side * thick;
        const auto turned = [&](double u) { return side > 0 ? u : 1 - u; };
        p.sheet(steps, 1, [&](double u, double v) {
            const Point low = on(arch, turned(u), z);
            return v == 0 ? low : Point{low.x, above, z + at.z};
        });
        for (const double x : {0.0, bay / 2 + arch}) {
            const Point a = at + Point{x, spring, z}, b = a + Point{bay / 2 - arch, 0, 0}, up{0, above - spring, 0};
            side > 0 ? p.quad(a, b, b + up, a + up) : p.quad(b, a, a + up, b + up);
        }
    }
    p.material("stone");
    p.sheet(steps, 1, [&](double u, double v) { return on(arch, u, thick * (1 - 2 * v)); });
    for (const double side : {1.0, -1.0})
        p.sheet(steps, 3, [&](double u, double v) {
            const int k = static_cast<int>(std::lround(3 * v));
            const double w = side > 0 ? u : 1 - u, out = thick + (k == 1 || k == 2 ? 0.035 : 0);
            return on(arch + (k >= 2 ? 0.17 : 0), w, side * out);
        });
    p.box(at + Point{bay / 2 - 0.11, spring + arch - 0.04, -thick - 0.07},
          at + Point{bay / 2 + 0.11, spring + arch + 0.26, thick + 0.07}, 0.02);
}

// A groin vault over the bay from (0, 0) to (bay, -bay).
void vault(Pieces& p, Point at)
{
    constexpr int n = 10;
    p.material("vault");
    p.sheet(n, n, [&](double u, double v) {
        // Rings that bunch where the vault is steep.
        const double x = -std::cos(pi * u), z = -std::cos(pi * v), r = bay / 2;
        const double rise = std::sqrt(std::fmax(1 - std::fmin(x * x, z * z), 0));
        return at + Point{r + r * x, spring + 0.02 + (r - 0.02) * rise, -r + r * z};
    });
}

void lower_bay(Pieces& p, double x, bool corner)
{
    constexpr double deep = -bay;
    vault(p, {x, 0, 0});
    // Paving, in two stones.
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            p.material((i + j) % 2 ? "paving_dark" : "paving_light");
            const double a = x + i * bay / 4, z = -j * bay / 4, s = bay / 4;
            p.quad({a, 0, z}, {a + s, 0, z}, {a + s, 0, z - s}, {a, 0, z - s});
        }
    // The back wall, every other bay with a door.
    p.material("wall");
    const bool door = static_cast<int>(std::lround((x + 30) / bay)) % 2 == 0 && !corner;
    std::vector<Pieces::Opening> openings;
    if (door) openings = {{0.9, 2.1, 0, 2.35}};
    p.wall({x, 0, deep}, {bay, 0, 0}, {0, floor_2, 0}, 0.3, openings);
    if (door) {
        p.material("wood");
        p.box({x + 0.9, 0, deep - 0.25}, {x + 2.1, 2.35, deep - 0.2}, 0);
        for (const double a : {x + 0.98, x + 1.54})
            for (const auto& [y0, y1] : {std::array{0.12, 0.95}, {1.07, 2.25}})
                p.box({a, y0, deep - 0.21}, {a + 0.48, y1, deep - 0.175}, 0.02);
        p.material("stone");
        for (const double a : {x + 0.74, x + 2.1}) p.box({a, 0, deep - 0.02}, {a + 0.16, 2.35, deep + 0.06}, 0.015);
        p.box({x + 0.70, 2.35, deep - 0.02}, {x + 2.30, 2.56, deep + 0.08}, 0.015);
    }
    p.material("stone");
    p.box({x, 0, deep - 0.02}, {x + bay, 0.30, deep + 0.035}, 0.012);
    // A half pillar that takes the vault, and the arch across to the column.
    p.box({x - 0.18, 0, deep}, {x + 0.18, 0.42, deep + 0.16}, 0.02);
    p.box({x - 0.14, 0.42, deep}, {x + 0.14, spring - 0.16, deep + 0.12}, 0.012);
    p.box({x - 0.20, spring - 0.16, deep}, {x + 0.20, spring, deep + 0.18}, 0.02);
    p.sheet(14, 3, [&](double u, double v) {
        const int k = static_cast<int>(std::lround(3 * v));
        const double a = pi * u, r = k == 0 || k == 3 ? bay / 2 : bay / 2 - 0.09, half = 0.13;
        return Point{x + (k < 2 ? -half : half), spring + r * std::sin(a), deep / 2 + r * std::cos(a)};
    });
}

void upper_bay(Pieces& p, double x)
{
    p.material("stone");
    p.box({x + 0.16, floor_2 + 0.02, -0.13}, {x + bay - 0.16, floor_2 + 0.16, 0.13}, 0.015);
    p.box({x + 0.16, floor_2 + 0.90, -0.14}, {x + bay - 0.16, floor_2 + 1.04, 0.14}, 0.025);
    const Pieces::Profile baluster{{0.072, 0},    {0.072, 0.05}, {0.046, 0.09}, {0.085, 0.25},
                                   {0.074, 0.35}, {0.037, 0.55}, {0.068, 0.68}, {0.070, 0.74}};
    for (int k = 0; k < 6; ++k) p.turned({x + 0.16 + 0.4467 * (k + 0.5), floor_2 + 0.16, 0}, baluster, 8);
}

void side(Pieces& p, const Side& s)
{
    p.place(s.middle, s.turn);
    const double half = s.bays * bay / 2, end = half + bay;
    for (int i = 0; i < s.bays; ++i) {
        const double x = -half + i * bay;
        arch_in_wall(p, {x, 0, 0}, floor_2 - 0.3);
        upper_bay(p, x);
    }
    for (int i = 0; i <= s.bays; ++i) lower_bay(p, -half + i * bay, i == s.bays);
    p.material("wall");
    p.wall({-end, 0, -bay}, {bay, 0, 0}, {0, floor_2, 0}, 0.3, {});
    for (int i = 0; i < s.bays; ++i) {  // each corner belongs to one side
        const double x = -half + i * bay;
        p.material("stone");
        p.box({x - 0.33, 0, -0.33}, {x + 0.33, 0.14, 0.33}, 0.015);
        p.box({x - 0.32, spring - 0.14, -0.32}, {x + 0.32, spring, 0.32}, 0.02);
        p.material("column");
        p.turned({x, 0.14, 0}, column(spring - 0.28, 0.21), 24);
        p.material("stone");
        p.box({x - 0.24, floor_2 + 0.02, -0.24}, {x + 0.24, floor_2 + 1.04, 0.24}, 0.02);
        p.box({x - 0.22, floor_2 + column_2, -0.22}, {x + 0.22, floor_2 + column_2 + 0.10, 0.22}, 0.015);
        p.material("column");
        p.turned({x, floor_2 + 1.04, 0}, column(column_2 - 1.04, 0.15), 14);
    }
    // Courses of stone along the court, the upper floor, the beams and the roof.
    p.material("stone");
    const auto course = [&](double y0, double y1, double out, double bevel) {
        p.box({-half - out, y0, -thick}, {half + out, y1, out}, bevel);
    };
    course(floor_2 - 0.30, floor_2 - 0.18, thick + 0.05, 0.02),
        course(floor_2 - 0.18, floor_2 + 0.02, thick + 0.13, 0.03);
    p.material("plaster");
    p.box({-half - 0.2, floor_2 + column_2 + 0.10, -0.2}, {half + 0.2, top - 0.30, 0.2}, 0);
    p.material("stone");
    course(top - 0.30, top - 0.20, 0.30, 0.02), course(top - 0.20, top - 0.06, 0.42, 0.03);
    p.material("paving_light");
    p.quad({-half, floor_2, 0}, {end, floor_2, 0}, {end, floor_2, -bay}, {-half, floor_2, -bay});
    p.material("wall");
    p.wall({-end, floor_2, -bay}, {2 * end, 0, 0}, {0, top - floor_2, 0}, 0.3, {});
    p.material("wood");
    for (double x = -half + 0.3; x < end; x += 0.6)
        p.box({x - 0.06, top - 0.52, -bay}, {x + 0.06, top - 0.34, -0.2}, 0);
    p.box({-half, top - 0.34, -bay}, {end, top - 0.30, -0.1}, 0);
    p.material("tiles");
    p.quad({-end - 0.3, top + 0.75, -bay - 0.3}, {-half - 0.45, top - 0.06, 0.45}, {half + 0.45, top - 0.06, 0.45},
           {end + 0.3, top + 0.75, -bay - 0.3});
    p.place({});
}

void court(Pieces& p)
{
    p.material("court");
    p.quad({-6, -0.02, 9}, {6, -0.02, 9}, {6, -0.02, -9}, {-6, -0.02, -9});
    p.material("stone");
    for (const double s : {-1.0, 1.0}) {
        p.box({-6.3, -0.1, s * 9 - 0.3}, {6.3, 0.002, s * 9 + 0.3}, 0),
            p.box({s * 6 - 0.3, -0.1, -9}, {s * 6 + 0.3, 0.001, 9}, 0);
        p.box({-5.4, -0.05, s * 2.6 - 0.15}, {5.4, -0.012, s * 2.6 + 0.15}, 0);
    }
    // The well in the middle, and trees in pots.
    p.turned({0, -0.02, 0},
             {{0, 0},
              {1.55, 0},
              {1.55, 0.16},
              {1.5, 0.18},
              {1.22, 0.18},
              {1.20, 0.22},
              {1.24, 0.60},
              {1.32, 0.66},
              {1.36, 0.74},
              {1.32, 0.80},
              {1.06, 0.80},
              {1.02, 0.76},
              {1.02, 0.35},
              {0, 0.35}},
             48);
    p.turned({0, 0.33, 0},
             {{0.3, 0},
              {0.3, 0.1},
              {0.16, 0.25},
              {0.13, 0.7},
              {0.18, 0.9},
              {0.45, 1.0},
              {0.62, 1.12},
              {0.64, 1.16},
              {0.60, 1.16},
              {0.42, 1.06},
              {0, 1.03}},
             32);
    Random random(41);
    for (const double x : {-4.2, 4.2})
        for (const double z : {-6.6, 6.6}) {
            p.material("pot");
            p.turned({x, -0.02, z},
                     {{0, 0},
                      {0.30, 0},
                      {0.33, 0.04},
                      {0.44, 0.52},
                      {0.50, 0.54},
                      {0.50, 0.64},
                      {0.45, 0.65},
                      {0.43, 0.56},
                      {0, 0.56}},
                     24);
            p.material("wood");
            p.rod({{x, 0.5, z}, {x + 0.03, 1.0, z - 0.02}, {x, 1.6, z}}, 0.045, 8);
            p.material("leaf");
            for (int k = 0; k < 200; ++k) {
                Point d;
                do d = {random.spread(1), random.spread(1), random.spread(1)};
                while (length(d) > 1 || length(d) < 0.55);
                const Point at = Point{x, 1.95, z} + d * 0.62,
                            along = unit(d + Point{random.spread(0.6), random.spread(0.6), random.spread(0.6)});
                const Point wide = across(along, {random.spread(1), 1, random.spread(1)}) * 0.035;
                p.quad(at - wide, at + along * 0.07 - wide * 0.2, at + along * 0.10 + wide, at + along * 0.02 + wide);
            }
        }
}

}  // namespace

int main(int argc, char** argv)
{
    Pieces p(only_argument(argc, argv, "make_atrium OUTPUT_FOLDER") + "/atrium.obj", "atrium.mtl", 1e-3, 0);
    for (const Side& s : sides) side(p, s);
    court(p);
}
