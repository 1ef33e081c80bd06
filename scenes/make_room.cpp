// Writes the living room of room.toml, in tenths of a millimetre: x from window to door, z from the sofa to the eye.
//   g++ -std=c++20 -O2 scenes/make_room.cpp -o make_room && ./make_room scenes/meshes
#include "make_rooms.h"

namespace {

constexpr double left = -2.6, right = 2.6, far = -2.4, near = 2.6, height = 2.7;

struct Window {
    double from, to, raised;  // along z; how far the lower sash stands open
    double blind;             // where the blind ends
};
constexpr double sill = 0.55, head = 2.25, reveal = 0.26;
constexpr std::array<Window, 2> windows{Window{-1.75, -0.65, 0.40, 1.06}, Window{0.05, 1.15, 0.62, 0.90}};

void shell(Pieces& p)
{
    p.material("floor");
    p.pictured_quad({left, 0, near}, {right, 0, near}, {right, 0, far}, {left, 0, far});
    p.material("ceiling");
    p.quad({left, height, far}, {right, height, far}, {right, height, near}, {left, height, near});
    p.material("far_wall");
    p.wall({left, 0, far}, {right - left, 0, 0}, {0, height, 0}, 0, {});
    p.material("wall");
    p.wall({right, 0, far}, {0, 0, near - far}, {0, height, 0}, 0, {});
    p.wall({right, 0, near}, {left - right, 0, 0}, {0, height, 0}, 0, {});
    std::vector<Pieces::Opening> openings;
    for (const Window& w : windows) openings.push_back({near - w.to, near - w.from, sill, head});
    p.wall({left, 0, near}, {0, 0, far - near}, {0, height, 0}, reveal, openings);

    p.material("paint");
    const auto strip = [&](double y0, double y1, double out) {
        const double bevel = 0.3 * std::fmin(out, 0.02);
        p.box({left, y0, far}, {right, y1, far + out}, bevel);
        p.box({left, y0, near - out}, {right, y1, near}, bevel);
        p.box({left, y0, far}, {left + out, y1, near}, bevel);
        p.box({right - out, y0, far}, {right, y1, near}, bevel);
    };
    strip(-0.02, 0.09, 0.018), strip(0.082, 0.115, 0.012);
    strip(height - 0.035, height + 0.01, 0.085), strip(height - 0.07, height - 0.03, 0.05),
        strip(height - 0.10, height - 0.065, 0.022);
}

// Four panes in a frame, in the plane x, from z0 to z1.
void sash(Pieces& p, double x, double z0, double z1, double y0, double y1)
{
    constexpr double stile = 0.045, bar = 0.018, deep = 0.036;
    p.material("paint");
    const auto piece = [&](double a0, double b0, double a1, double b1, double d) {
        p.box({x - d / 2, b0, a0}, {x + d / 2, b1, a1}, 0.004);
    };
    piece(z0, y0, z0 + stile, y1, deep), piece(z1 - stile, y0, z1, y1, deep);
    piece(z0 + stile, y0, z1 - stile, y0 + 1.2 * stile, deep), piece(z0 + stile, y1 - stile, z1 - stile, y1, deep);
    const double z = (z0 + z1) / 2, y = (y0 + y1) / 2;
    piece(z - bar / 2, y0 + stile, z + bar / 2, y1 - stile, 0.6 * deep);
    piece(z0 + stile, y - bar / 2, z1 - stile, y + bar / 2, 0.6 * deep);
    p.material("pane");
    p.quad({x, y0 + 0.03, z1 - 0.03}, {x, y0 + 0.03, z0 + 0.03}, {x, y1 - 0.03, z0 + 0.03}, {x, y1 - 0.03, z1 - 0.03});
}

void window(Pieces& p, const Window& w)
{
    const double x = left - reveal, half = (sill + head) / 2;
    p.material("paint");
    for (const double z : {w.from, w.to - 0.04}) p.box({x, sill, z}, {x + 0.12, head, z + 0.04}, 0.004);
    p.box({x, head - 0.04, w.from}, {x + 0.12, head, w.to}, 0.004);
    p.box({x - 0.06, sill - 0.03, w.from - 0.02}, {x + 0.12, sill + 0.02, w.to + 0.02}, 0.004);
    p.box({left - reveal + 0.1, sill - 0.035, w.from - 0.06}, {left + 0.07, sill + 0.002, w.to + 0.06}, 0.008);
    // The architrave about the opening.
    for (const double z : {w.from - 0.075, w.to}) p.box({left, sill, z}, {left + 0.02, head + 0.075, z + 0.075}, 0.006);
    p.box({left, head, w.from - 0.09}, {left + 0.026, head + 0.085, w.to + 0.09}, 0.006);
    sash(p, x + 0.035, w.from + 0.04, w.to - 0.04, half - 0.02, head - 0.04);
    sash(p, x + 0.085, w.from + 0.04, w.to - 0.04, sill + 0.02 + w.raised, half + 0.02 + w.raised);

    // The blind: slats that curve, tilted a little, on cords.
    p.material("blind");
    const double hung = left - 0.075;
    p.box({hung - 0.028, head - 0.05, w.from + 0.02}, {hung + 0.028, head - 0.005, w.to - 0.02}, 0.003);
    constexpr double wide = 0.05, tilt = 18 * pi / 180;
    double y = head - 0.075;
    for (; y > w.blind; y -= 0.042)
        p.sheet(1, 4, [&](double u, double v) {
            const double s = (v - 0.5) * wide, sag = 0.004 * (1 - 4 * (v - 0.5) * (v - 0.5));
            return Point{hung + s * std::cos(tilt) - sag * std::sin(tilt),
                         y + s * std::sin(tilt) + sag * std::cos(tilt), w.to - 0.03 - u * (w.to - w.from - 0.06)};
        });
    p.box({hung - 0.022, y + 0.012, w.from + 0.03}, {hung + 0.022, y + 0.03, w.to - 0.03}, 0.003);
    for (const double t : {0.15, 0.5, 0.85}) {
        const double z = w.from + t * (w.to - w.from);
        for (const double side : {-0.024, 0.024})
            p.rod({{hung + side, head - 0.05, z}, {hung + side, y + 0.02, z}}, 0.0012, 4);
    }
}

void curtains(Pieces& p)
{
    constexpr double rail = 2.46, out = left + 0.13;
    p.material("brass");
    p.rod({{out, rail, -2.2}, {out, rail, 1.72}}, 0.013, 12);
    for (const double z : {-2.2, 1.72})
        p.turned({out, rail - 0.03, z}, {{0, 0}, {0.02, 0.008}, {0.03, 0.03}, {0.02, 0.052}, {0, 0.06}}, 12);
    for (const double z : {-2.1, -0.3, 1.65}) p.rod({{left, rail - 0.01, z}, {out, rail - 0.01, z}}, 0.008, 8);
    p.material("curtain");
    Random random(71);
    for (const auto& [from, to, folds] :
         {std::tuple{-2.16, -1.80, 5.0}, {-0.60, -0.33, 4.0}, {-0.27, 0.0, 4.0}, {1.2, 1.66, 6.0}}) {
        const double phase = random.in(0, 6), slow = random.in(0, 6);
        p.sheet(static_cast<int>(folds) * 12, 26, [&, from = from, to = to, folds = folds](double u, double v) {
            const double swing = 0.026 + 0.022 * v, gather = 1 - 0.10 * std::sin(pi * v);
            const double a = 2 * pi * folds * u + phase + 0.9 * std::sin(3.1 * u + 2.2 * v + slow);
            const double z = (from + to) / 2 + (u - 0.5) * (from - to) * gather * -1 + 0.006 * std::cos(2 * a);
            return Point{out + swing * std::sin(a) + 0.006 * std::sin(9 * u + 5 * v), rail - 0.02 - v * (rail - 0.045),
                         z};
        });
    }
}

void lamp(Pieces& p)
{
    p.place({-2.02, 0, -1.86});
    p.material("brass");
    p.turned(
        {0, 0, 0},
        {{0, 0}, {0.135, 0}, {0.14, 0.004}, {0.14, 0.014}, {0.13, 0.02}, {0.03, 0.026}, {0.016, 0.04}, {0.011, 0.07}},
        40);
    p.rod({{0, 0.06, 0}, {0, 1.42, 0}}, 0.011, 14);
    p.turned({0, 1.40, 0}, {{0.011, 0}, {0.022, 0.01}, {0.024, 0.06}, {0.018, 0.075}, {0, 0.075}}, 20);
    for (int k = 0; k < 3; ++k) {
        const double a = 2 * pi * k / 3;
        p.rod({{0, 1.435, 0},
               {0.12 * std::cos(a), 1.46, 0.12 * std::sin(a)},
               {0.218 * std::cos(a), 1.46, 0.218 * std::sin(a)}},
              0.0025, 6);
    }
    p.material("shade");
    p.sheet(64, 6, [](double u, double v) {
        const double r = 0.225 - 0.065 * v, a = -2 * pi * u;
        return Point{r * std::cos(a), 1.42 + 0.30 * v, r * std::sin(a)};
    });
    p.material("curtain");
    for (const double v : {0.0, 1.0}) {
        std::vector<Point> hoop;
        for (int k = 0; k <= 48; ++k)
            hoop.push_back({(0.225 - 0.065 * v) * std::cos(2 * pi * k / 48), 1.42 + 0.30 * v,
                            (0.225 - 0.065 * v) * std::sin(2 * pi * k / 48)});
        p.rod(hoop, 0.004, 6);
    }
    p.place({});
}

void sofa(Pieces& p)
{
    p.place({-0.25, 0, -1.86});
    p.material("oak_turned");
    for (const double x : {-1.0, 1.0})
        for (const double z : {-0.36, 0.36}) p.turned({x, 0, z}, {{0, 0}, {0.014, 0}, {0.024, 0.13}, {0, 0.13}}, 14);
    p.material("sofa");
    p.cushion({-1.08, 0.12, -0.44}, {1.08, 0.30, 0.42}, 0.03, 0);
    p.cushion({-1.08, 0.14, -0.46}, {1.08, 0.74, -0.26}, 0.06, 0);
    for (const double x : {-1.14, 0.96}) p.cushion({x, 0.12, -0.46}, {x + 0.18, 0.58, 0.43}, 0.06, 0);
    for (const double x : {-0.955, -0.315, 0.325}) p.cushion({x, 0.29, -0.30}, {x + 0.63, 0.45, 0.45}, 0.05, 0.018, 6);
    for (const double x : {-0.64, 0.0, 0.64}) {
        p.place({-0.25 + x, 0.60, -1.86 - 0.16}, 0, -76);
        p.cushion({-0.31, -0.075, -0.19}, {0.31, 0.075, 0.19}, 0.06, 0.03, 6);
    }
    p.material("pillow");
    p.place({-0.25 - 0.66, 0.63, -1.74}, 18, -62);
    p.cushion({-0.22, -0.045, -0.22}, {0.22, 0.045, 0.22}, 0.035, 0.045, 6);
    p.material("pillow_light");
    p.place({-0.25 + 0.68, 0.63, -1.72}, -24, -60);
    p.cushion({-0.21, -0.045, -0.21}, {0.21, 0.045, 0.21}, 0.035, 0.045, 6);
    p.place({});
}

void table(Pieces& p)
{
    p.place({-0.15, 0, -0.42}, 4);
    p.material("oak");
    p.board({-0.60, 0.385, -0.32}, {0.60, 0.42, 0.32}, 0.006, 0.2);
    p.board({-0.50, 0.33, -0.24}, {0.50, 0.385, -0.215}, 0.003, 1.1);
    p.board({-0.50, 0.33, 0.215}, {0.50, 0.385, 0.24}, 0.003, 1.7);
    p.material("oak_turned");
    for (const double x : {-0.52, 0.52})
        for (const double z : {-0.25, 0.25}) p.turned({x, 0, z}, {{0, 0}, {0.013, 0}, {0.024, 0.386}, {0, 0.386}}, 16);
    p.material("book_1");
    p.box({0.27, 0.42, -0.06}, {0.52, 0.447, 0.20}, 0.002);
    p.place({-0.15, 0, -0.42}, 16);
    p.material("book_4");
    p.box({0.25, 0.447, 0.00}, {0.46, 0.467, 0.22}, 0.002);
    p.place({});
    // A vase of glass, one body with an inside.
    p.material("vase");
    p.place({0.06, 0.4201, -0.62});
    p.turned({0, 0, 0}, {{0, 0},         {0.040, 0},     {0.048, 0.004}, {0.058, 0.03},  {0.066, 0.07},  {0.066, 0.11},
                         {0.055, 0.16},  {0.038, 0.20},  {0.033, 0.23},  {0.036, 0.255}, {0.044, 0.275}, {0.042, 0.278},
                         {0.033, 0.257}, {0.029, 0.23},  {0.034, 0.20},  {0.050, 0.158}, {0.061, 0.11},  {0.061, 0.072},
                         {0.053, 0.035}, {0.040, 0.018}, {0, 0.014}},
             48);
    p.place({});
}

void chair(Pieces& p)
{
    p.place({1.22, 0, -0.98}, -58);
    p.material("oak");
    p.board({-0.22, 0.435, -0.21}, {0.22, 0.460, 0.23}, 0.008, 0.6);
    p.material("oak_turned");
    for (const double x : {-0.19, 0.19}) {
        p.rod({{x * 1.12, 0, 0.22}, {x, 0.44, 0.18}}, 0.017, 12);
        p.rod({{x * 1.12, 0, -0.27}, {x, 0.44, -0.19}, {x, 0.62, -0.21}, {x, 0.88, -0.275}}, 0.017, 12);
        p.rod({{x * 1.06, 0.2, 0.2}, {x * 1.06, 0.2, -0.23}}, 0.010, 10);
    }
    p.rod({{-0.2, 0.2, -0.01}, {0.2, 0.2, -0.01}}, 0.010, 10);
    // Bent rails of the back.
    const auto rail = [&](double y, double z, double tall) {
        p.sheet(20, 4, [&](double u, double v) {
            const bool top = v == 0.25 || v == 0.5, front = v == 0 || v == 0.25 || v == 1;
            return Point{-0.2 + 0.4 * u, y + (top ? tall : 0),
                         z - 0.03 * std::sin(pi * u) - (top ? 0.02 : 0) + (front ? 0.009 : -0.009)};
        });
    };
    rail(0.80, -0.255, 0.085), rail(0.67, -0.225, 0.05);
    p.place({});
}

void shelf(Pieces& p)
{
    constexpr double x0 = 1.28, x1 = 2.42, deep = 0.30, top = 2.08, thick = 0.026;
    const double z0 = far + 0.02, z1 = z0 + deep;
    p.material("oak");
    Random random(81);
    for (const double x : {x0, x1 - thick}) p.board({x, 0, z0}, {x + thick, top, z1}, 0.003, random.in(0, 5));
    p.board({x0 + thick, 0.06, z0}, {x1 - thick, top, z0 + 0.012}, 0.001, random.in(0, 5));
    constexpr int shelves = 6;
    std::array<double, shelves> ys{0.06, 0.46, 0.83, 1.18, 1.51, top - thick};
    for (const double y : ys)
        p.board({x0 + thick, y, z0 + 0.012}, {x1 - thick, y + thick, z1 - 0.004}, 0.003, random.in(0, 5));
    for (size_t s = 0; s + 1 < shelves; ++s) {
        const double floor = ys[s] + thick, room = ys[s + 1] - floor;
        double x = x0 + thick + 0.006;
        // One shelf leaves room for what stands in the scene file, others end early.
        const double end = x1 - thick - (s == 2 ? 0.42 : s == 4 ? 0.30 : random.in(0.02, 0.16));
        while (true) {
            const double w = random.in(0.016, 0.045), h = random.in(0.62, 0.93) * std::min(room, 0.31),
                         d = random.in(0.14, 0.22);
            if (x + w > end) break;
            p.material("book_" + std::to_string(1 + static_cast<int>(random.in(0, 6.999))));
            p.box({x, floor, z1 - 0.03 - d}, {x + w, floor + h, z1 - 0.03 - random.in(0, 0.012)}, 0.003);
            p.material("paper");
            p.box({x + 0.003, floor + h - 0.004, z1 - 0.026 - d}, {x + w - 0.003, floor + h - 0.0005, z1 - 0.046}, 0);
            x += w + 0.0008;
        }
    }
}

void plant(Pieces& p)
{
    p.place({-2.16, 0, -0.30});
    p.material("pot");
    p.turned({0, 0, 0},
             {{0, 0},
              {0.10, 0},
              {0.112, 0.008},
              {0.145, 0.24},
              {0.158, 0.245},
              {0.160, 0.285},
              {0.146, 0.288},
              {0.140, 0.25},
              {0, 0.25}},
             40);
    p.material("leaf");
    Random random(91);
    for (int i = 0; i < 15; ++i) {
        const double a = 2.4 * i + random.spread(0.3), from = 0.02 + 0.005 * i, lean = 0.10 + 0.016 * i,
                     tall = random.in(0.42, 0.86), wide = random.in(0.022, 0.034);
        const double twist = random.spread(1.2);
        p.sheet(4, 14, [&](double u, double v) {
            const double w = wide * std::sqrt(std::sin(pi * std::fmin(0.12 + 0.88 * v, 0.98))) * (2 * u - 1),
                         out = from + lean * v * v;
            const double b = a + pi / 2 + twist * v, fold = 0.35 * std::fabs(w);
            return Point{out * std::cos(a) + w * std::cos(b) + fold * std::cos(a), 0.25 + tall * v,
                         out * std::sin(a) + w * std::sin(b) + fold * std::sin(a)};
        });
    }
    p.place({});
}

void picture(Pieces& p)
{
    constexpr double x0 = -0.83, x1 = 0.37, y0 = 1.25, y1 = 2.0;
    const double z = far + 0.004;
    p.material("oak");
    p.board({x0 - 0.02, y0 - 0.02, z}, {x1 + 0.02, y0 + 0.01, z + 0.035}, 0.003, 0.3);
    p.board({x0 - 0.02, y1 - 0.01, z}, {x1 + 0.02, y1 + 0.02, z + 0.035}, 0.003, 1.3);
    for (const double x : {x0 - 0.02, x1 - 0.01})
        p.board({x, y0 + 0.01, z}, {x + 0.03, y1 - 0.01, z + 0.035}, 0.003, x + 3);
    p.material("painting");
    p.pictured_quad({x0, y0, z + 0.02}, {x1, y0, z + 0.02}, {x1, y1, z + 0.02}, {x0, y1, z + 0.02});
    p.material("rug");
    p.place({-0.15, 0, -0.5}, 2);
    p.pictured_quad({-1.3, 0.012, 0.9}, {1.3, 0.012, 0.9}, {1.3, 0.012, -0.9}, {-1.3, 0.012, -0.9});
    for (int k = 0; k < 4; ++k) {
        const std::array<Point, 4> c{Point{-1.3, 0, 0.9}, {1.3, 0, 0.9}, {1.3, 0, -0.9}, {-1.3, 0, -0.9}};
        const Point a = c[static_cast<size_t>(k)], b = c[static_cast<size_t>((k + 1) % 4)], up{0, 0.012, 0};
        p.pictured_quad(a, b, b + up, a + up);
    }
    p.place({});
}

}  // namespace

int main(int argc, char** argv)
{
    Pieces p(only_argument(argc, argv, "make_room OUTPUT_FOLDER") + "/room.obj", "room.mtl", 1e-4, 0);
    shell(p);
    for (const Window& w : windows) window(p, w);
    curtains(p);
    lamp(p);
    sofa(p);
    table(p);
    chair(p);
    shelf(p);
    plant(p);
    picture(p);
}
